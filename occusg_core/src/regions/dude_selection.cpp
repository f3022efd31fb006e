// SPDX-License-Identifier: BSD-3-Clause
#include "regions/dude_selection.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

namespace occusg {
namespace {

/// Pieces that grow together.
class Merging {
 public:
  Merging(const std::vector<DudePiece>& pieces, const std::vector<DudeLink>& links)
      : pieces_(pieces), parents_(pieces.size()), links_of_(pieces.size()) {
    std::iota(parents_.begin(), parents_.end(), 0);
    for (std::size_t i = 0; i < links.size(); ++i) {
      linksOf(links[i].piece_a).push_back(i);
      linksOf(links[i].piece_b).push_back(i);
    }
  }

  int find(int piece) {
    while (parent(piece) != piece) {
      parent(piece) = parent(parent(piece));
      piece = parent(piece);
    }
    return piece;
  }

  [[nodiscard]] const DudePiece& at(int root) const {
    return pieces_[static_cast<std::size_t>(root)];
  }
  [[nodiscard]] std::vector<std::size_t>& linksOf(int root) {
    return links_of_[static_cast<std::size_t>(root)];
  }

  /// @return the root of the merged piece.
  int merge(int piece_a, int piece_b) {
    int a = find(piece_a);
    int b = find(piece_b);
    if (a == b) return a;
    if (linksOf(a).size() < linksOf(b).size()) std::swap(a, b);
    parent(b) = a;
    DudePiece& grown = pieces_[static_cast<std::size_t>(a)];
    grown.radius_cells = std::max(grown.radius_cells, at(b).radius_cells);
    grown.area_cells += at(b).area_cells;
    linksOf(a).insert(linksOf(a).end(), linksOf(b).begin(), linksOf(b).end());
    std::vector<std::size_t>().swap(linksOf(b));
    return a;
  }

 private:
  int& parent(int piece) { return parents_[static_cast<std::size_t>(piece)]; }

  std::vector<DudePiece> pieces_;
  std::vector<int> parents_;
  std::vector<std::vector<std::size_t>> links_of_;
};

/// Half the cut over the radius on its smaller side.
double widthRatio(const DudeLink& link, double smaller_radius) {
  if (smaller_radius <= 0.0) return std::numeric_limits<double>::infinity();
  return 0.5 * link.length_cells / (smaller_radius * (1.0 + link.keep_bonus));
}

void dropWide(const std::vector<DudeLink>& links, double max_ratio, Merging& merging) {
  // Largest ratio first, then shallow before deep, long before short, late before early.
  using Entry = std::tuple<double, double, double, std::size_t>;
  std::priority_queue<Entry> queue;
  const auto ratioOf = [&](std::size_t i) {
    const int a = merging.find(links[i].piece_a);
    const int b = merging.find(links[i].piece_b);
    return widthRatio(links[i], std::min(merging.at(a).radius_cells, merging.at(b).radius_cells));
  };
  const auto push = [&](std::size_t i, double ratio) {
    if (ratio >= max_ratio) queue.emplace(ratio, -links[i].depth_cells, links[i].length_cells, i);
  };
  for (std::size_t i = 0; i < links.size(); ++i) push(i, ratioOf(i));
  while (!queue.empty()) {
    const auto [ratio, shallowness, length, i] = queue.top();
    queue.pop();
    if (merging.find(links[i].piece_a) == merging.find(links[i].piece_b)) continue;
    // Radii only grow, so ratios only fall: an entry is either right or too high.
    const double now = ratioOf(i);
    if (now < ratio) {
      push(i, now);
    } else {
      merging.merge(links[i].piece_a, links[i].piece_b);
    }
  }
}

/// The longest cut round a piece; its links when it has none.
std::size_t longestLink(int root, const std::vector<DudeLink>& links, Merging& merging) {
  std::size_t best = links.size();
  for (const std::size_t i : merging.linksOf(root)) {
    if (merging.find(links[i].piece_a) == merging.find(links[i].piece_b)) continue;
    if (best == links.size() || links[i].length_cells > links[best].length_cells ||
        (links[i].length_cells == links[best].length_cells && i < best))
      best = i;
  }
  return best;
}

void joinSmall(const std::vector<DudeLink>& links, std::int64_t min_area, std::size_t piece_count,
               Merging& merging) {
  using Entry = std::pair<std::int64_t, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::size_t i = 0; i < piece_count; ++i) {
    const int piece = static_cast<int>(i);
    if (merging.find(piece) == piece && merging.at(piece).area_cells < min_area)
      queue.emplace(merging.at(piece).area_cells, piece);
  }
  while (!queue.empty()) {
    const auto [area, piece] = queue.top();
    queue.pop();
    if (merging.find(piece) != piece || merging.at(piece).area_cells != area) continue;
    const std::size_t link = longestLink(piece, links, merging);
    if (link == links.size()) continue;
    const int grown = merging.merge(links[link].piece_a, links[link].piece_b);
    if (merging.at(grown).area_cells < min_area) queue.emplace(merging.at(grown).area_cells, grown);
  }
}

void dropShallow(const std::vector<DudeLink>& links, double threshold, Merging& merging) {
  for (const DudeLink& link : links) {
    if (link.depth_cells * (1.0 + link.keep_bonus) < threshold)
      merging.merge(link.piece_a, link.piece_b);
  }
}

DudeSelection numbered(const std::vector<DudePiece>& pieces, const std::vector<DudeLink>& links,
                       Merging& merging) {
  DudeSelection selection;
  std::vector<int> number_of_root(pieces.size(), -1);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    int& number = number_of_root[static_cast<std::size_t>(merging.find(static_cast<int>(i)))];
    if (number < 0) number = selection.count++;
    selection.merged_piece.push_back(number);
  }
  for (const DudeLink& link : links)
    selection.is_kept.push_back(merging.find(link.piece_a) != merging.find(link.piece_b) ? 1 : 0);
  return selection;
}

}  // namespace

DudeSelection selectCuts(const std::vector<DudePiece>& pieces, const std::vector<DudeLink>& links,
                         const DudeSelectionRules& rules) {
  Merging merging(pieces, links);
  dropWide(links, rules.max_width_ratio, merging);
  joinSmall(links, rules.min_area_cells, pieces.size(), merging);
  dropShallow(links, rules.depth_threshold_cells, merging);
  return numbered(pieces, links, merging);
}

}  // namespace occusg
