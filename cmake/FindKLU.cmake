# Defines KLU::KLU, the sparse LU factorisation of SuiteSparse; include it as <klu.h>.
#
# SuiteSparse 7 has a CMake package, SuiteSparse 5 none. Only the LGPL and BSD parts are linked:
# UMFPACK, SPQR and parts of CHOLMOD are GPL.

find_package(KLU CONFIG QUIET)
if(TARGET SuiteSparse::KLU)
  set(KLU_LIBRARY SuiteSparse::KLU)
  set(KLU_REQUIRED KLU_LIBRARY)
else()
  find_path(KLU_INCLUDE_DIR klu.h PATH_SUFFIXES suitesparse)
  find_library(KLU_LIBRARY klu)
  set(KLU_REQUIRED KLU_LIBRARY KLU_INCLUDE_DIR)
  set(KLU_LIBRARIES ${KLU_LIBRARY})
  foreach(part amd colamd btf suitesparseconfig)
    find_library(KLU_${part}_LIBRARY ${part})
    list(APPEND KLU_REQUIRED KLU_${part}_LIBRARY)
    list(APPEND KLU_LIBRARIES ${KLU_${part}_LIBRARY})
    mark_as_advanced(KLU_${part}_LIBRARY)
  endforeach()
  mark_as_advanced(KLU_INCLUDE_DIR KLU_LIBRARY)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(KLU REQUIRED_VARS ${KLU_REQUIRED})

if(KLU_FOUND AND NOT TARGET KLU::KLU)
  add_library(KLU::KLU INTERFACE IMPORTED)
  if(TARGET SuiteSparse::KLU)
    target_link_libraries(KLU::KLU INTERFACE SuiteSparse::KLU)
  else()
    target_link_libraries(KLU::KLU INTERFACE ${KLU_LIBRARIES})
    target_include_directories(KLU::KLU SYSTEM INTERFACE ${KLU_INCLUDE_DIR})
  endif()
endif()
