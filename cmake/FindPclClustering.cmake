# SPDX-License-Identifier: BSD-3-Clause
# Finds the few PCL libraries that Euclidean clustering needs and defines PclClustering::PclClustering.
# PCL's own package configuration would also demand VTK, Qt and MPI, which nothing here uses.
file(GLOB _pcl_include_hints /usr/include/pcl-1.* /usr/local/include/pcl-1.*)
find_path(PclClustering_INCLUDE_DIR pcl/search/kdtree.h HINTS ${_pcl_include_hints})
set(_pcl_variables PclClustering_INCLUDE_DIR)
set(_pcl_libraries "")
foreach(_component common kdtree search)
  find_library(PclClustering_${_component}_LIBRARY pcl_${_component})
  list(APPEND _pcl_variables PclClustering_${_component}_LIBRARY)
  list(APPEND _pcl_libraries "${PclClustering_${_component}_LIBRARY}")
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(PclClustering REQUIRED_VARS ${_pcl_variables})
if(PclClustering_FOUND AND NOT TARGET PclClustering::PclClustering)
  add_library(PclClustering::PclClustering INTERFACE IMPORTED)
  set_target_properties(PclClustering::PclClustering PROPERTIES
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${PclClustering_INCLUDE_DIR}"
    INTERFACE_INCLUDE_DIRECTORIES "${PclClustering_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${_pcl_libraries}")
endif()
mark_as_advanced(${_pcl_variables})
