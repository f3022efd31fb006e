// SPDX-License-Identifier: BSD-3-Clause
#include "regions/dude_pieces.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>

namespace occusg {
namespace {

/// Where a row of cells enters a piece.
struct Entry {
  double x = 0.0;  ///< Exact crossing of the row's middle line, only compared.
  int first_cell = 0;
  int piece = 0;  ///< -1: outside.
};

std::int64_t floorDivided(std::int64_t numerator, std::int64_t positive_denominator) {
  const std::int64_t quotient = numerator / positive_denominator;
  return quotient * positive_denominator > numerator ? quotient - 1 : quotient;
}

CellBox boundsOf(const std::vector<Cell>& points) {
  CellBox corners;
  for (const Cell& point : points) corners = corners.including(point);
  return {corners.min, {corners.max.x - 1, corners.max.y - 1}};
}

class Rasteriser {
 public:
  explicit Rasteriser(const CellBox& box)
      : box_(box), rows_(static_cast<std::size_t>(box.height())) {}

  /// From here on to the right, rows between the ends of the edge are in `piece`.
  void addEdge(const Cell& end_a, const Cell& end_b, int piece) {
    const Cell& low = end_a.y < end_b.y ? end_a : end_b;
    const Cell& high = end_a.y < end_b.y ? end_b : end_a;
    const std::int64_t height = high.y - low.y;
    const std::int64_t width = high.x - low.x;
    for (int y = low.y; y < high.y; ++y) {
      // The edge passes the row's middle at low.x + offset / (2 height).
      const std::int64_t offset = width * (2 * static_cast<std::int64_t>(y - low.y) + 1);
      // First cell whose middle is not left of that: ceil(offset / (2 height) - 1 / 2).
      const std::int64_t first = -floorDivided(height - offset, 2 * height);
      rows_[static_cast<std::size_t>(y - box_.min.y)].push_back(
          {low.x + static_cast<double>(offset) / static_cast<double>(2 * height),
           low.x + static_cast<int>(first), piece});
    }
  }

  [[nodiscard]] Grid<std::int32_t> filled() {
    Grid<std::int32_t> values(box_, -1);
    for (int y = box_.min.y; y < box_.max.y; ++y) {
      std::vector<Entry>& row = rows_[static_cast<std::size_t>(y - box_.min.y)];
      std::sort(row.begin(), row.end(), [](const Entry& a, const Entry& b) { return a.x < b.x; });
      for (std::size_t i = 0; i + 1 < row.size(); ++i) {
        for (int x = row[i].first_cell; x < row[i + 1].first_cell; ++x)
          values.at({x, y}) = row[i].piece;
      }
    }
    return values;
  }

 private:
  CellBox box_;
  std::vector<std::vector<Entry>> rows_;
};

/// Cells of equal value side by side in one row.
struct Run {
  int y = 0;
  int first = 0;
  int end = 0;
  std::int32_t value = 0;
  std::size_t part = 0;  ///< A run of the same 4-connected part, its first one once settled.
};

class Parts {
 public:
  explicit Parts(const Grid<std::int32_t>& values) {
    std::size_t row_below = 0;
    for (int y = values.box().min.y; y < values.box().max.y; ++y) {
      const std::size_t row = runs_.size();
      addRow(values, y);
      row_begins_.push_back(row);
      connect(row_below, row, [this](std::size_t below, std::size_t above) {
        if (runs_[below].value == runs_[above].value) join(below, above);
      });
      row_below = row;
    }
    row_begins_.push_back(runs_.size());
    for (std::size_t run = 0; run < runs_.size(); ++run) runs_[run].part = find(run);
    cells_.assign(runs_.size(), 0);
    for (const Run& run : runs_) cells_[run.part] += run.end - run.first;
  }

  [[nodiscard]] const std::vector<Run>& runs() const { return runs_; }
  [[nodiscard]] std::int64_t cells(std::size_t part) const { return cells_[part]; }

  /// Calls visit(lower run, upper run) for any two that touch.
  template <typename Visitor>
  void visitContacts(Visitor visit) {
    for (std::size_t i = 0; i + 2 < row_begins_.size(); ++i)
      connect(row_begins_[i], row_begins_[i + 1], visit, row_begins_[i + 2]);
  }

 private:
  void addRow(const Grid<std::int32_t>& values, int y) {
    const CellBox& box = values.box();
    for (int x = box.min.x; x < box.max.x;) {
      Run run{y, x, x + 1, values.at({x, y}), runs_.size()};
      while (run.end < box.max.x && values.at({run.end, y}) == run.value) ++run.end;
      x = run.end;
      if (run.value >= 0) runs_.push_back(run);
    }
  }

  /// Walks two rows of runs side by side.
  template <typename Visitor>
  void connect(std::size_t below, std::size_t above, Visitor visit) {
    connect(below, above, visit, runs_.size());
  }
  template <typename Visitor>
  void connect(std::size_t below, std::size_t above, Visitor visit, std::size_t end) {
    const std::size_t end_below = above;
    while (below < end_below && above < end) {
      if (std::max(runs_[below].first, runs_[above].first) <
          std::min(runs_[below].end, runs_[above].end))
        visit(below, above);
      (runs_[below].end < runs_[above].end ? below : above) += 1;
    }
  }

  std::size_t find(std::size_t run) {
    while (runs_[run].part != run) {
      runs_[run].part = runs_[runs_[run].part].part;
      run = runs_[run].part;
    }
    return run;
  }

  /// The earlier run stands for both.
  void join(std::size_t a, std::size_t b) {
    const std::size_t root_a = find(a);
    const std::size_t root_b = find(b);
    runs_[std::max(root_a, root_b)].part = std::min(root_a, root_b);
  }

  std::vector<Run> runs_;
  std::vector<std::size_t> row_begins_;
  std::vector<std::int64_t> cells_;
};

/// The largest part of every value; the number of runs where it has none.
std::vector<std::size_t> mainParts(const Parts& parts, int count) {
  const std::vector<Run>& runs = parts.runs();
  std::vector<std::size_t> main(static_cast<std::size_t>(count), runs.size());
  for (std::size_t run = 0; run < runs.size(); ++run) {
    if (runs[run].part != run) continue;
    std::size_t& best = main[static_cast<std::size_t>(runs[run].value)];
    if (best == runs.size() || parts.cells(run) > parts.cells(best)) best = run;
  }
  return main;
}

/// How many cell edges every crumb shares with the largest part of each value.
using Contacts = std::map<std::size_t, std::map<std::int32_t, int>>;

/// Ties: the smaller value.
std::int32_t mostMet(const std::map<std::int32_t, int>& edges_with) {
  return std::max_element(edges_with.begin(), edges_with.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

Contacts contactsOfCrumbs(Parts& parts, const std::vector<char>& is_main) {
  Contacts contacts;
  const std::vector<Run>& runs = parts.runs();
  const auto meet = [&](const Run& a, const Run& b, int edges) {
    if (is_main[a.part] == 0 && is_main[b.part] != 0) contacts[a.part][b.value] += edges;
    if (is_main[b.part] == 0 && is_main[a.part] != 0) contacts[b.part][a.value] += edges;
  };
  parts.visitContacts([&](std::size_t below, std::size_t above) {
    meet(runs[below], runs[above],
         std::min(runs[below].end, runs[above].end) -
             std::max(runs[below].first, runs[above].first));
  });
  for (std::size_t run = 1; run < runs.size(); ++run) {
    if (runs[run].y == runs[run - 1].y && runs[run].first == runs[run - 1].end)
      meet(runs[run - 1], runs[run], 1);
  }
  return contacts;
}

}  // namespace

DudeFlood floodedPieces(const DudeMesh& mesh, const std::vector<DudeCandidate>& cuts) {
  std::vector<std::array<char, 3>> is_cut(mesh.faces.size(), {0, 0, 0});
  for (const DudeCandidate& cut : cuts) {
    const auto face = static_cast<std::size_t>(cut.face);
    is_cut[face][static_cast<std::size_t>(cut.side)] = 1;
    const auto other =
        static_cast<std::size_t>(mesh.faces[face].neighbours[static_cast<std::size_t>(cut.side)]);
    for (std::size_t side = 0; side < 3; ++side)
      if (mesh.faces[other].neighbours[side] == cut.face) is_cut[other][side] = 1;
  }
  DudeFlood flood;
  flood.piece_of_face.assign(mesh.faces.size(), -1);
  std::vector<std::size_t> open;
  for (std::size_t start = 0; start < mesh.faces.size(); ++start) {
    if (flood.piece_of_face[start] >= 0) continue;
    flood.piece_of_face[start] = flood.count;
    open.push_back(start);
    while (!open.empty()) {
      const std::size_t face = open.back();
      open.pop_back();
      for (std::size_t side = 0; side < 3; ++side) {
        const int next = mesh.faces[face].neighbours[side];
        if (next < 0 || is_cut[face][side] != 0) continue;
        int& piece = flood.piece_of_face[static_cast<std::size_t>(next)];
        if (piece >= 0) continue;
        piece = flood.count;
        open.push_back(static_cast<std::size_t>(next));
      }
    }
    ++flood.count;
  }
  return flood;
}

Grid<std::int32_t> rasterised(const DudeMesh& mesh, const DudeFlood& flood) {
  Rasteriser rasteriser(boundsOf(mesh.points));
  for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
    const int piece = flood.piece_of_face[face];
    for (std::size_t side = 0; side < 3; ++side) {
      const int other = mesh.faces[face].neighbours[side];
      const int piece_across =
          other < 0 ? -1 : flood.piece_of_face[static_cast<std::size_t>(other)];
      if (piece_across == piece) continue;
      const auto corner = [&](std::size_t i) -> const Cell& {
        return mesh.points[static_cast<std::size_t>(mesh.faces[face].corners[i % 3])];
      };
      const Cell& from = corner(side + 1);
      const Cell& to = corner(side + 2);
      // Faces lie left of their edges: right of one going down is across, left of it is larger x.
      if (to.y < from.y) rasteriser.addEdge(from, to, piece);
      if (to.y > from.y && other < 0) rasteriser.addEdge(from, to, -1);
    }
  }
  return rasteriser.filled();
}

int joinCrumbs(int count, Grid<std::int32_t>& values) {
  Parts parts(values);
  const std::vector<Run>& runs = parts.runs();
  std::vector<char> is_main(runs.size(), 0);
  for (const std::size_t part : mainParts(parts, count))
    if (part < runs.size()) is_main[part] = 1;
  const auto isCrumb = [&](const Run& run) { return is_main[run.part] == 0; };
  if (std::none_of(runs.begin(), runs.end(), isCrumb)) return count;
  const Contacts contacts = contactsOfCrumbs(parts, is_main);
  std::map<std::size_t, std::int32_t> value_of_crumb;
  for (const Run& run : runs) {
    if (!isCrumb(run)) continue;
    const auto [crumb, is_new] = value_of_crumb.try_emplace(run.part, 0);
    if (is_new) {
      const auto met = contacts.find(run.part);
      crumb->second = met == contacts.end() ? count++ : mostMet(met->second);
    }
    for (int x = run.first; x < run.end; ++x) values.at({x, run.y}) = crumb->second;
  }
  return count;
}

}  // namespace occusg
