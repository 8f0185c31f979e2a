# Makes an interface package of the course usable as a dependency of rosidl_generate_interfaces().
# Its wheel has one library and no headers: these are generated in the build folder, if a target needs them.
function(course_interfaces package python generator library)
  set(_output "${CMAKE_BINARY_DIR}/course_interfaces/${package}")
  set(_stamp "${_output}/${package}.stamp")
  file(MAKE_DIRECTORY "${_output}/include" "${_output}/introspection")
  add_custom_command(
    OUTPUT "${_stamp}"
    COMMAND "${python}" "${generator}" ${package} "${_output}"
    COMMAND "${CMAKE_COMMAND}" -E touch "${_stamp}"
    COMMENT "Generating the headers of ${package}")
  add_custom_target(${package}__headers DEPENDS "${_stamp}")
  add_library(${package}::${package} SHARED IMPORTED GLOBAL)
  set_target_properties(${package}::${package} PROPERTIES
    IMPORTED_LOCATION "${library}"
    INTERFACE_INCLUDE_DIRECTORIES "${_output}/include;${_output}/introspection"
    INTERFACE_LINK_LIBRARIES "${ARGN}")
  add_dependencies(${package}::${package} ${package}__headers)
endfunction()
