# SPDX-License-Identifier: BSD-3-Clause
# Makes the project a catkin package when catkin is installed; sets OCCUSG_HAVE_ROS.

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
set(OCCUSG_HAVE_ROS ON)

# Libraries come from the exported targets (occusg-extras.cmake): catkin would look for them by name
# in the prefix given when configuring, so a staged or moved install would not be found.
catkin_package(
  INCLUDE_DIRS occusg_core/include
  CFG_EXTRAS occusg-extras.cmake)
