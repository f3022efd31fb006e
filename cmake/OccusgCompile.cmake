# SPDX-License-Identifier: BSD-3-Clause
# Language level, warnings and sanitizers shared by every target of the project.

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  message(STATUS "No build type given: Release")
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

add_library(occusg_compile_options INTERFACE)
target_compile_options(occusg_compile_options INTERFACE -Wall -Wextra -Wpedantic)
if(OCCUSG_WARNINGS_AS_ERRORS)
  target_compile_options(occusg_compile_options INTERFACE -Werror)
endif()
if(OCCUSG_SANITIZE)
  add_compile_options(-fsanitize=${OCCUSG_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${OCCUSG_SANITIZE})
endif()
