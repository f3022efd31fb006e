# SPDX-License-Identifier: BSD-3-Clause
# Makes the project a catkin package when ROS is installed; sets OCCUSG_HAVE_ROS.

# Debian's ROS modules belong to the system's Python. Another one first on PATH (pyenv, conda) would
# be found by catkin (PYTHON_EXECUTABLE) and by ament_cmake_core (Python3_EXECUTABLE) and fail.
foreach(variable PYTHON_EXECUTABLE Python3_EXECUTABLE)
  if(NOT DEFINED ${variable} AND EXISTS /usr/bin/python3)
    set(${variable} /usr/bin/python3 CACHE FILEPATH "Python that has the ROS modules")
  endif()
endforeach()

# Read by the first find_package(catkin).
if(OCCUSG_RELOCATABLE_INSTALL)
  set(CATKIN_INSTALL_INTO_PREFIX_ROOT FALSE)
endif()

# What the ROS part needs: catkin's name and the Debian package; Ubuntu's are ros-noetic-<catkin's name>.
set(OCCUSG_ROS_NEEDS
  diagnostic_updater:libdiagnostic-updater-dev
  dynamic_reconfigure:libdynamic-reconfigure-config-init-mutex-dev
  geometry_msgs:libgeometry-msgs-dev
  image_transport:libimage-transport-dev
  map_msgs:libmap-msgs-dev
  message_filters:libmessage-filters-dev
  nav_msgs:libnav-msgs-dev
  nodelet:libnodeletlib-dev
  pluginlib:pluginlib-dev
  rosbag:librosbag-dev
  roscpp:libroscpp-dev
  rosgraph_msgs:libros-rosgraph-msgs-dev
  sensor_msgs:libsensor-msgs-dev
  std_msgs:libstd-msgs-dev
  std_srvs:libstd-srvs-dev
  tf2:libtf2-dev
  tf2_msgs:libtf2-msgs-dev
  tf2_ros:libtf2-ros-dev
  visualization_msgs:libvisualization-msgs-dev)
set(OCCUSG_ROS_PACKAGES "")
set(missing "")
foreach(need catkin:catkin message_generation:ros-message-generation ${OCCUSG_ROS_NEEDS})
  string(REGEX MATCH "^([^:]+):(.+)$" matched ${need})
  set(package ${CMAKE_MATCH_1})
  set(debian_package ${CMAKE_MATCH_2})
  find_package(${package} QUIET)
  if(NOT ${package}_FOUND)
    list(APPEND missing "${package} (${debian_package})")
  endif()
  if(NOT package MATCHES "^(catkin|message_generation)$")
    list(APPEND OCCUSG_ROS_PACKAGES ${package})
  endif()
endforeach()
if(missing)
  list(JOIN missing ", " missing)
  set(OCCUSG_ROS_ABSENCE "missing ROS packages, with Debian's names: ${missing}")
  if(OCCUSG_BUILD_ROS STREQUAL "AUTO")
    message(WARNING "Building without ROS, ${OCCUSG_ROS_ABSENCE}")
    return()
  endif()
  message(FATAL_ERROR "OCCUSG_BUILD_ROS is ON, but there are ${OCCUSG_ROS_ABSENCE}. "
    "scripts/install_dependencies.sh installs them; -DOCCUSG_BUILD_ROS=OFF builds without ROS.")
endif()
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
