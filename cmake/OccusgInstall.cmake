# SPDX-License-Identifier: BSD-3-Clause
# Installs the core and exports it as occusg::core, with catkin and without.
include(CMakePackageConfigHelpers)

set(OCCUSG_CMAKE_DIR share/occusg/cmake)
install(TARGETS occusg_core EXPORT occusgTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY occusg_core/include/occusg DESTINATION include)
install(EXPORT occusgTargets NAMESPACE occusg:: DESTINATION ${OCCUSG_CMAKE_DIR})
export(EXPORT occusgTargets NAMESPACE occusg:: FILE "${PROJECT_BINARY_DIR}/occusgTargets.cmake")

configure_file(cmake/occusgCore.cmake.in "${PROJECT_BINARY_DIR}/occusgCore.cmake" @ONLY)
foreach(finder FindPclClustering.cmake FindPolyclipping.cmake)
  configure_file(cmake/${finder} "${PROJECT_BINARY_DIR}/${finder}" COPYONLY)
  install(FILES cmake/${finder} DESTINATION ${OCCUSG_CMAKE_DIR})
endforeach()
install(FILES "${PROJECT_BINARY_DIR}/occusgCore.cmake" DESTINATION ${OCCUSG_CMAKE_DIR})

if(NOT OCCUSG_HAVE_ROS)
  # catkin writes a config of the same name; one of the two is enough.
  configure_package_config_file(cmake/occusgConfig.cmake.in
    "${PROJECT_BINARY_DIR}/occusgConfig.cmake" INSTALL_DESTINATION ${OCCUSG_CMAKE_DIR})
  write_basic_package_version_file("${PROJECT_BINARY_DIR}/occusgConfigVersion.cmake"
    COMPATIBILITY SameMinorVersion)
  #catkin_lint: ignore_once missing_file
  install(FILES "${PROJECT_BINARY_DIR}/occusgConfig.cmake"
    "${PROJECT_BINARY_DIR}/occusgConfigVersion.cmake" DESTINATION ${OCCUSG_CMAKE_DIR})
  install(FILES package.xml DESTINATION share/occusg)
endif()
install(DIRECTORY config launch rviz DESTINATION share/occusg)
install(DIRECTORY examples/apartment DESTINATION share/occusg/examples)
