# SPDX-License-Identifier: BSD-3-Clause
# Installs the libraries and exports them as occusg::core, occusg::io and occusg::evaluation, with catkin and without.
# What is installed can be moved: every file finds the others from where it lies itself.
include(CMakePackageConfigHelpers)

set(OCCUSG_CMAKE_DIR share/occusg/cmake)
install(TARGETS occusg_core occusg_libio occusg_libevaluation EXPORT occusgTargets
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

if(OCCUSG_HAVE_ROS)
  # catkin has written occusgConfig.cmake and occusg.pc, which ask for all of ROS and name the prefix. Its config goes
  # on under another name; the one others find brings it in unless they ask for the core alone.
  set(generated "${PROJECT_BINARY_DIR}/catkin_generated/installspace")
  file(READ "${generated}/occusgConfig.cmake" catkin_config)
  if(NOT catkin_config MATCHES "occusgCatkin.cmake")
    file(WRITE "${PROJECT_BINARY_DIR}/occusgCatkin.cmake" "${catkin_config}")
  endif()
  configure_file(cmake/occusgConfig.cmake.in "${generated}/occusgConfig.cmake" @ONLY)
  configure_file(cmake/occusg.pc.in "${generated}/occusg.pc" @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/occusgCatkin.cmake" DESTINATION ${OCCUSG_CMAKE_DIR})
  if(OCCUSG_RELOCATABLE_INSTALL)
    # In place of catkin's set-up files, which name the prefix that was given when configuring.
    install(FILES cmake/setup.bash cmake/setup.sh DESTINATION .)
    file(WRITE "${PROJECT_BINARY_DIR}/marker/.catkin" "")
    install(FILES "${PROJECT_BINARY_DIR}/marker/.catkin" DESTINATION .)
  endif()
else()
  configure_file(cmake/occusgConfig.cmake.in "${PROJECT_BINARY_DIR}/occusgConfig.cmake" @ONLY)
  configure_file(cmake/occusg.pc.in "${PROJECT_BINARY_DIR}/occusg.pc" @ONLY)
  write_basic_package_version_file("${PROJECT_BINARY_DIR}/occusgConfigVersion.cmake"
    COMPATIBILITY SameMinorVersion)
  #catkin_lint: ignore_once missing_file
  install(FILES "${PROJECT_BINARY_DIR}/occusgConfig.cmake"
    "${PROJECT_BINARY_DIR}/occusgConfigVersion.cmake" DESTINATION ${OCCUSG_CMAKE_DIR})
  #catkin_lint: ignore_once missing_file
  install(FILES "${PROJECT_BINARY_DIR}/occusg.pc" DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
  install(FILES package.xml DESTINATION share/occusg)
endif()
install(DIRECTORY config launch rviz DESTINATION share/occusg)
install(DIRECTORY examples/apartment DESTINATION share/occusg/examples)
