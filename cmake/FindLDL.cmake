# Defines LDL::LDL, the sparse LDL^T factorisation of SuiteSparse, and with it AMD, which orders for
# it; include them as <ldl.h> and <amd.h>.
#
# SuiteSparse 7 has CMake packages, SuiteSparse 5 none. LDL is LGPL, AMD is BSD.

find_package(LDL CONFIG QUIET)
find_package(AMD CONFIG QUIET)
if(TARGET SuiteSparse::LDL AND TARGET SuiteSparse::AMD)
  set(LDL_LIBRARIES SuiteSparse::LDL SuiteSparse::AMD)
  set(LDL_REQUIRED LDL_LIBRARIES)
else()
  find_path(LDL_INCLUDE_DIR ldl.h PATH_SUFFIXES suitesparse)
  set(LDL_REQUIRED LDL_INCLUDE_DIR)
  set(LDL_LIBRARIES)
  foreach(part ldl amd suitesparseconfig)
    find_library(LDL_${part}_LIBRARY ${part})
    list(APPEND LDL_REQUIRED LDL_${part}_LIBRARY)
    list(APPEND LDL_LIBRARIES ${LDL_${part}_LIBRARY})
    mark_as_advanced(LDL_${part}_LIBRARY)
  endforeach()
  mark_as_advanced(LDL_INCLUDE_DIR)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(LDL REQUIRED_VARS ${LDL_REQUIRED})

if(LDL_FOUND AND NOT TARGET LDL::LDL)
  add_library(LDL::LDL INTERFACE IMPORTED)
  target_link_libraries(LDL::LDL INTERFACE ${LDL_LIBRARIES})
  if(LDL_INCLUDE_DIR)
    target_include_directories(LDL::LDL SYSTEM INTERFACE ${LDL_INCLUDE_DIR})
  endif()
endif()
