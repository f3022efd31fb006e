# SPDX-License-Identifier: BSD-3-Clause
# Makes the project a catkin package when ROS is installed; sets OCCUSG_HAVE_ROS.

# Debian's ROS modules belong to the system's Python. Another one first on PATH (pyenv, conda) would
# be found by catkin (PYTHON_EXECUTABLE) and by ament_cmake_core (Python3_EXECUTABLE) and fail.
foreach(variable PYTHON_EXECUTABLE Python3_EXECUTABLE)
  if(NOT DEFINED ${variable} AND EXISTS /usr/bin/python3)
    set(${variable} /usr/bin/python3 CACHE FILEPATH "Python that has the ROS modules")
  endif()
endforeach()

find_package(catkin QUIET)
if(NOT catkin_FOUND)
  message(STATUS "catkin not found: building the core and the command line without ROS")
  return()
endif()

set(OCCUSG_ROS_PACKAGES
  diagnostic_updater
  dynamic_reconfigure
  geometry_msgs
  image_transport
  message_filters
  nav_msgs
  nodelet
  pluginlib
  rosbag
  roscpp
  rosgraph_msgs
  sensor_msgs
  std_msgs
  std_srvs
  tf2
  tf2_msgs
  tf2_ros
  visualization_msgs)
foreach(package message_generation ${OCCUSG_ROS_PACKAGES})
  find_package(${package} QUIET)
  if(NOT ${package}_FOUND)
    message(STATUS "catkin is there but ${package} is not: building without ROS")
    return()
  endif()
endforeach()
find_package(catkin REQUIRED COMPONENTS message_generation ${OCCUSG_ROS_PACKAGES})
set(OCCUSG_HAVE_ROS ON)

file(GLOB messages CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}/occusg_ros/msg"
  "${PROJECT_SOURCE_DIR}/occusg_ros/msg/*.msg")
file(GLOB services CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}/occusg_ros/srv"
  "${PROJECT_SOURCE_DIR}/occusg_ros/srv/*.srv")
add_message_files(DIRECTORY msg BASE_DIR "${PROJECT_SOURCE_DIR}/occusg_ros/msg" FILES ${messages})
add_service_files(DIRECTORY occusg_ros/srv FILES ${services})
generate_messages(DEPENDENCIES geometry_msgs nav_msgs sensor_msgs std_msgs)
# rosmsg and rossrv look into the share folder of the package, and nowhere else.
foreach(message ${messages})
  configure_file("occusg_ros/msg/${message}"
    "${CATKIN_DEVEL_PREFIX}/share/${PROJECT_NAME}/msg/${message}" COPYONLY)
endforeach()
foreach(service ${services})
  configure_file("occusg_ros/srv/${service}"
    "${CATKIN_DEVEL_PREFIX}/share/${PROJECT_NAME}/srv/${service}" COPYONLY)
  install(FILES "occusg_ros/srv/${service}" DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/srv)
endforeach()
generate_dynamic_reconfigure_options(
  occusg_ros/cfg/MappingLive.cfg
  occusg_ros/cfg/SceneGraphLive.cfg)

# Libraries come from the exported targets (occusg-extras.cmake): catkin would look for them by name
# in the prefix given when configuring, so a staged or moved install would not be found.
catkin_package(
  INCLUDE_DIRS occusg_core/include occusg_ros/include
  CATKIN_DEPENDS message_runtime ${OCCUSG_ROS_PACKAGES}
  CFG_EXTRAS occusg-extras.cmake)
