/* Included before every generated C file, so that one build works with every Python from 3.11 on.
 *
 * The generated code reads objects with unchecked macros that Python's stable ABI lacks. Each is replaced by the
 * function that does the same with a check. PyFloat_AsDouble also converts an int correctly, for which the macro
 * would send 5e-324, as in `point.x = 1`.
 */
#include <assert.h>
#include <stdio.h>
#include <string.h>

#define PY_SSIZE_T_CLEAN
#include <Python.h>

#define PyBytes_AS_STRING PyBytes_AsString
#define PyFloat_AS_DOUBLE PyFloat_AsDouble
#define PyUnicode_1BYTE_DATA(text) PyUnicode_AsUTF8AndSize((text), NULL)
#undef PySequence_Fast_GET_ITEM
#define PySequence_Fast_GET_ITEM(items, i) \
  (PyList_Check(items) ? PyList_GetItem((items), (i)) : PyTuple_GetItem((items), (i)))
