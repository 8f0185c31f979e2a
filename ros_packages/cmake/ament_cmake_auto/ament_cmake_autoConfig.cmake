# Finds the dependencies that package.xml names, and exports them. There is nothing for C++ nodes here.
find_package(ament_cmake REQUIRED)
set(ament_cmake_auto_FOUND_AMENT_PACKAGE TRUE)

# Find each dependency of the build. Those after REQUIRED must be there.
macro(ament_auto_find_build_dependencies)
  cmake_parse_arguments(_auto "" "" "REQUIRED" ${ARGN})
  if(NOT _AMENT_PACKAGE_NAME)
    ament_package_xml()
  endif()
  foreach(_auto_dependency ${_auto_REQUIRED})
    find_package(${_auto_dependency} REQUIRED)
  endforeach()
  foreach(_auto_dependency ${${PROJECT_NAME}_BUILD_DEPENDS} ${${PROJECT_NAME}_BUILDTOOL_DEPENDS})
    find_package(${_auto_dependency} QUIET)
    if(${_auto_dependency}_FOUND)
      list(APPEND ${PROJECT_NAME}_FOUND_BUILD_DEPENDS ${_auto_dependency})
    endif()
  endforeach()
endmacro()

# A program or library in C++.
foreach(_auto_kind executable library)
  cmake_language(EVAL CODE "
    macro(ament_auto_add_${_auto_kind} target)
      message(FATAL_ERROR \"\${target} is in C++, and C++ nodes are not built here. Write the node in Python, or remove the lines of \${target}.\")
    endmacro()")
endforeach()

# Find each dependency of the tests.
macro(ament_auto_find_test_dependencies)
  if(NOT _AMENT_PACKAGE_NAME)
    ament_package_xml()
  endif()
  foreach(_auto_dependency ${${PROJECT_NAME}_TEST_DEPENDS})
    find_package(${_auto_dependency} QUIET)
  endforeach()
endmacro()

# Install the folders after INSTALL_TO_SHARE, export the dependencies and end the package.
macro(ament_auto_package)
  cmake_parse_arguments(_auto "INSTALL_TO_PATH" "" "INSTALL_TO_SHARE" ${ARGN})
  foreach(_auto_dependency ${${PROJECT_NAME}_BUILD_EXPORT_DEPENDS})
    if(${_auto_dependency}_FOUND)
      ament_export_dependencies(${_auto_dependency})
    endif()
  endforeach()
  foreach(_auto_folder ${_auto_INSTALL_TO_SHARE})
    install(DIRECTORY ${_auto_folder} DESTINATION share/${PROJECT_NAME})
  endforeach()
  ament_package(${_auto_UNPARSED_ARGUMENTS})
endmacro()
