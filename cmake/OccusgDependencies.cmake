# SPDX-License-Identifier: BSD-3-Clause
# The libraries of the core; see docs/architecture.md for what each is used for.
find_package(CGAL REQUIRED)
# NO_MODULE: CGAL brings a finder for Eigen that defines no target.
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(nlohmann_json REQUIRED)
find_package(octomap REQUIRED)
find_package(OpenCV REQUIRED COMPONENTS core dnn imgproc imgcodecs)
find_package(PclClustering REQUIRED)
find_package(Polyclipping REQUIRED)
find_package(Threads REQUIRED)
find_package(yaml-cpp REQUIRED)

add_library(occusg_octomap INTERFACE)
target_include_directories(occusg_octomap SYSTEM INTERFACE ${OCTOMAP_INCLUDE_DIRS})
target_link_libraries(occusg_octomap INTERFACE ${OCTOMAP_LIBRARIES})
