// SPDX-License-Identifier: BSD-3-Clause
#include "regions/dude_mesh.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <cstddef>

namespace occusg {
namespace {

/// Number of an inside face in the mesh, or what is known of it before it has one.
constexpr int kUnseen = -3;
constexpr int kInside = -2;
constexpr int kOutside = -1;

struct FaceNumber {
  int value = kUnseen;
};

struct CornerNumber {
  int value = -1;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<CornerNumber, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<FaceNumber, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>;

/// @param first_number of the ring's corners.
void insertRing(const CornerRing& ring, int first_number, Triangulation& triangulation) {
  std::vector<Triangulation::Vertex_handle> vertices;
  vertices.reserve(ring.size());
  Triangulation::Face_handle hint;
  for (const Cell& corner : ring) {
    vertices.push_back(triangulation.insert(Kernel::Point_2(corner.x, corner.y), hint));
    hint = vertices.back()->face();
    int& number = vertices.back()->info().value;
    if (number < 0) number = first_number + static_cast<int>(vertices.size()) - 1;
  }
  for (std::size_t i = 0; i < ring.size(); ++i)
    triangulation.insert_constraint(vertices[i], vertices[(i + 1) % ring.size()]);
}

/// Marks every face inside or outside: sides change across ring edges only.
void markSides(Triangulation& triangulation) {
  std::vector<Triangulation::Face_handle> open{triangulation.infinite_face()};
  open.back()->info().value = kOutside;
  while (!open.empty()) {
    const Triangulation::Face_handle face = open.back();
    open.pop_back();
    for (int i = 0; i < 3; ++i) {
      const Triangulation::Face_handle next = face->neighbor(i);
      if (next->info().value != kUnseen) continue;
      const bool is_inside = (face->info().value == kInside) != face->is_constrained(i);
      next->info().value = is_inside ? kInside : kOutside;
      open.push_back(next);
    }
  }
}

std::vector<DudeMesh::Face> insideFaces(Triangulation& triangulation) {
  int count = 0;
  for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end();
       ++face)
    if (face->info().value == kInside) face->info().value = count++;
  std::vector<DudeMesh::Face> faces;
  faces.reserve(static_cast<std::size_t>(count));
  for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end();
       ++face) {
    if (face->info().value < 0) continue;
    DudeMesh::Face plain{};
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(i);
      plain.corners[at] = face->vertex(i)->info().value;
      plain.neighbours[at] = face->is_constrained(i) ? -1 : face->neighbor(i)->info().value;
    }
    faces.push_back(plain);
  }
  return faces;
}

}  // namespace

DudeMesh triangulated(const std::vector<CornerRing>& rings) {
  DudeMesh mesh;
  Triangulation triangulation;
  for (const CornerRing& ring : rings) {
    insertRing(ring, static_cast<int>(mesh.points.size()), triangulation);
    mesh.points.insert(mesh.points.end(), ring.begin(), ring.end());
  }
  if (triangulation.dimension() < 2) return mesh;
  markSides(triangulation);
  mesh.faces = insideFaces(triangulation);
  return mesh;
}

}  // namespace occusg
