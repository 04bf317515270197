# Finds the distribution's OpenVDB. (OpenVDB's own module also asks for Boost components and Imath's Python binding,
# which its headers do not need; version.h carries the options that the library was built with.)
find_path(OpenVDB_INCLUDE_DIR openvdb/openvdb.h)
find_library(OpenVDB_LIBRARY openvdb)
find_path(Imath_INCLUDE_DIR Imath/half.h)
find_library(Imath_LIBRARY NAMES Imath Imath-3_1)
if(OpenVDB_INCLUDE_DIR)
  file(STRINGS "${OpenVDB_INCLUDE_DIR}/openvdb/version.h" _version REGEX "OPENVDB_LIBRARY_(MAJOR|MINOR|PATCH)_VERSION_NUMBER [0-9]+")
  list(TRANSFORM _version REPLACE ".* ([0-9]+).*" "\\1")
  list(SUBLIST _version 0 3 _version)
  string(REPLACE ";" "." OpenVDB_VERSION "${_version}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenVDB REQUIRED_VARS OpenVDB_LIBRARY OpenVDB_INCLUDE_DIR Imath_INCLUDE_DIR Imath_LIBRARY
                                  VERSION_VAR OpenVDB_VERSION)
if(OpenVDB_FOUND AND NOT TARGET OpenVDB::openvdb)
  add_library(OpenVDB::openvdb SHARED IMPORTED)
  set_target_properties(OpenVDB::openvdb PROPERTIES
    IMPORTED_LOCATION "${OpenVDB_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${OpenVDB_INCLUDE_DIR};${Imath_INCLUDE_DIR}/Imath"
    INTERFACE_LINK_LIBRARIES "TBB::tbb;${Imath_LIBRARY}")
endif()
mark_as_advanced(OpenVDB_INCLUDE_DIR OpenVDB_LIBRARY Imath_INCLUDE_DIR Imath_LIBRARY)
