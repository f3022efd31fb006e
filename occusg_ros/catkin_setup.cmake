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

# What the ROS part needs, and Debian's package of it; Ubuntu's are ros-noetic-<catkin's name>.
set(debian_catkin catkin)
set(debian_message_generation ros-message-generation)
set(debian_diagnostic_updater libdiagnostic-updater-dev)
set(debian_dynamic_reconfigure libdynamic-reconfigure-config-init-mutex-dev)
set(debian_geometry_msgs libgeometry-msgs-dev)
set(debian_image_transport libimage-transport-dev)
set(debian_map_msgs libmap-msgs-dev)
set(debian_message_filters libmessage-filters-dev)
set(debian_nav_msgs libnav-msgs-dev)
set(debian_nodelet libnodeletlib-dev)
set(debian_pluginlib pluginlib-dev)
set(debian_rosbag librosbag-dev)
set(debian_roscpp libroscpp-dev)
set(debian_rosgraph_msgs libros-rosgraph-msgs-dev)
set(debian_sensor_msgs libsensor-msgs-dev)
set(debian_std_msgs libstd-msgs-dev)
set(debian_std_srvs libstd-srvs-dev)
set(debian_tf2 libtf2-dev)
set(debian_tf2_msgs libtf2-msgs-dev)
set(debian_tf2_ros libtf2-ros-dev)
set(debian_visualization_msgs libvisualization-msgs-dev)
set(OCCUSG_ROS_PACKAGES
  diagnostic_updater
  dynamic_reconfigure
  geometry_msgs
  image_transport
  map_msgs
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
set(missing "")
foreach(package catkin message_generation ${OCCUSG_ROS_PACKAGES})
  find_package(${package} QUIET)
  if(NOT ${package}_FOUND)
    list(APPEND missing "${package} (${debian_${package}})")
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
