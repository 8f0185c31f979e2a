// Finds the type support of a message or service inside this shared object.
//
// The stock dispatcher opens lib<package>__<typesupport>.so by its bare name. Here all type supports of a
// package are in one file, so it is enough to look up the symbol in that file. compile.py makes the generated code
// call these two functions instead of the stock ones.

#include <dlfcn.h>

#include <cstring>

#include "rosidl_runtime_c/message_type_support_struct.h"
#include "rosidl_runtime_c/service_type_support_struct.h"
#include "rosidl_typesupport_c/type_support_map.h"

#if defined(__x86_64__) && defined(__GLIBC__)
// As of glibc 2.34 these have another version, which older systems lack.
__asm__(".symver dladdr,dladdr@GLIBC_2.2.5");
__asm__(".symver dlopen,dlopen@GLIBC_2.2.5");
__asm__(".symver dlsym,dlsym@GLIBC_2.2.5");
#endif

namespace
{

void * this_shared_object()
{
  static void * handle = [] {
      Dl_info info;
      return dladdr(reinterpret_cast<void *>(&this_shared_object), &info) ?
             dlopen(info.dli_fname, RTLD_LAZY | RTLD_NOLOAD) : nullptr;
    }();
  return handle;
}

template<typename TypeSupport>
const TypeSupport * dispatch(const TypeSupport * handle, const char * identifier)
{
  if (std::strcmp(handle->typesupport_identifier, identifier) == 0) {
    return handle;
  }
  auto known = static_cast<const type_support_map_t *>(handle->data);
  for (size_t i = 0; i < known->size; ++i) {
    if (std::strcmp(known->typesupport_identifier[i], identifier) == 0) {
      auto get = reinterpret_cast<const TypeSupport * (*)()>(dlsym(this_shared_object(), known->symbol_name[i]));
      return get ? get() : nullptr;
    }
  }
  return nullptr;
}

}  // namespace

// Hidden, so that each package calls its own.
extern "C" __attribute__((visibility("hidden")))
const rosidl_message_type_support_t * dispatch_message(
  const rosidl_message_type_support_t * handle, const char * identifier)
{
  return dispatch(handle, identifier);
}

extern "C" __attribute__((visibility("hidden")))
const rosidl_service_type_support_t * dispatch_service(
  const rosidl_service_type_support_t * handle, const char * identifier)
{
  return dispatch(handle, identifier);
}
