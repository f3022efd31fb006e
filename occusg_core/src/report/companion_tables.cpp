// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "evaluation/score_estimates.hpp"
#include "report/html_text.hpp"
#include "report/report_cells.hpp"
#include "report/report_tables.hpp"

namespace occusg {
namespace {

/// Mean over the scenes that define the value.
std::string meanShare(const BatchResults& batch, const std::string& name,
                      const std::function<std::optional<double>(const SceneResult&)>& value) {
  double sum = 0.0, count = 0.0;
  for (const SceneResult& result : batch.results) {
    if (result.configuration != name || !result.metrics) continue;
    const auto share = value(result);
    if (!share) continue;
    sum += *share;
    count += 1.0;
  }
  return shownShare(count > 0.0 ? std::optional<double>(sum / count) : std::nullopt);
}

std::string observedTable(const BatchResults& batch) {
  HtmlTable table{"observed",
                  "Observed rooms only: an annotated room counts when at least a quarter of its "
                  "floor was seen. Macro averages, beside the protocol above.",
                  {{{"configuration"},
                    {"rooms left out"},
                    {"R"},
                    {"P"},
                    {"F1"},
                    {"mIoU"},
                    {"bF1"},
                    {"F1 at .50"},
                    {"F1 at .75"}}},
                  {}};
  for (std::size_t i = 0; i < batch.configurations.size(); ++i) {
    std::vector<RoomMetrics> scenes;
    std::size_t unseen = 0;
    for (const SceneResult& result : batch.results) {
      if (result.configuration != batch.configurations[i] || !result.observed) continue;
      scenes.push_back(result.observed->metrics);
      unseen += result.observed->n_unseen;
    }
    const ScoreEstimates scores = estimate(scenes, Averaging::kMacro);
    if (scores.at.size() != 3) continue;
    HtmlRow row{{lettered(batch, i)}, {std::to_string(unseen)}};
    for (const Estimate& value :
         {scores.at[0].recall, scores.at[0].precision, scores.at[0].f1, scores.at[0].mean_iou,
          scores.at[0].boundary_f1, scores.at[1].f1, scores.at[2].f1})
      row.push_back(estimateCell(value));
    table.body.push_back(std::move(row));
  }
  return table.body.empty() ? "" : toHtml(table);
}

HtmlTable relationTable(const BatchResults& batch) {
  HtmlTable table{"relations",
                  "Relations, macro averages: which rooms are joined, where the doors are (0.5 m), "
                  "which objects were found (1 m) and whether they are in the right room.",
                  {{{"configuration"},
                    {"adjacency R"},
                    {"P"},
                    {"F1"},
                    {"doors R", "class=\"group\""},
                    {"P"},
                    {"F1"},
                    {"objects R", "class=\"group\""},
                    {"P"},
                    {"in the right room"}}},
                  {}};
  for (std::size_t i = 0; i < batch.configurations.size(); ++i) {
    const std::string& name = batch.configurations[i];
    HtmlRow row{{lettered(batch, i)}};
    const auto add = [&](const std::function<std::optional<double>(const SceneResult&)>& value,
                         const char* attributes) {
      row.push_back({meanShare(batch, name, value), attributes});
    };
    // Rooms that come without any door, as external ones may, are not judged by them.
    const bool has_doors =
        countOf(batch, name, [](const SceneResult& r) { return r.doors.n_predicted > 0; }) > 0;
    const auto ofDoors = [has_doors](const auto& value) {
      return [has_doors, value](const SceneResult& r) {
        return has_doors ? value(r) : std::optional<double>();
      };
    };
    add(ofDoors([](const SceneResult& r) { return r.adjacency.recall(); }), "");
    add(ofDoors([](const SceneResult& r) { return r.adjacency.precision(); }), "");
    add(ofDoors([](const SceneResult& r) { return r.adjacency.f1(); }), "");
    add(ofDoors([](const SceneResult& r) { return r.doors.recall(); }), "class=\"group\"");
    add(ofDoors([](const SceneResult& r) { return r.doors.precision(); }), "");
    add(ofDoors([](const SceneResult& r) { return r.doors.f1(); }), "");
    const auto ofObjects = [](const auto& value) {
      return [value](const SceneResult& r) {
        return r.objects ? value(*r.objects) : std::optional<double>();
      };
    };
    add(ofObjects([](const ObjectScore& s) { return s.detection.recall(); }), "class=\"group\"");
    add(ofObjects([](const ObjectScore& s) { return s.detection.precision(); }), "");
    add(ofObjects([](const ObjectScore& s) { return s.containment(); }), "");
    table.body.push_back(std::move(row));
  }
  return table;
}

/// Durations of all scenes pooled: as if every call had been booked in one list.
struct PooledTime {
  double count = 0.0;
  double sum_ms = 0.0;
  double squares = 0.0;
  double max_ms = 0.0;

  void add(const StageTime& time) {
    count += time.count;
    sum_ms += time.count * time.mean_ms;
    squares += time.count * (time.std_ms * time.std_ms + time.mean_ms * time.mean_ms);
    max_ms = std::max(max_ms, time.max_ms);
  }
  [[nodiscard]] double mean_ms() const { return count > 0.0 ? sum_ms / count : 0.0; }
  [[nodiscard]] double std_ms() const {
    if (!(count > 0.0)) return 0.0;
    return std::sqrt(std::max(0.0, squares / count - mean_ms() * mean_ms()));
  }
};

struct StageName {
  const char* key;
  const char* shown;
};

constexpr std::array<StageName, 7> kStageNames{{{"point_cloud", "Point-cloud generation"},
                                                {"occupancy", "3D occupancy integration"},
                                                {"free_space", "2D free-space projection"},
                                                {"decomposition", "Decomposition"},
                                                {"tracking", "Region tracking"},
                                                {"graph", "Entity assignment and graph assembly"},
                                                {"total", "Total per frame"}}};

HtmlRow runTimeRow(const BatchResults& batch, const std::vector<std::string>& timed,
                   const StageName& stage) {
  HtmlRow row{{stage.shown}};
  for (const std::string& name : timed) {
    PooledTime pooled;
    for (const SceneResult& result : batch.results) {
      if (result.configuration != name) continue;
      for (const StageTime& time : result.times)
        if (time.stage == stage.key) pooled.add(time);
    }
    row.push_back({shownNumber(pooled.mean_ms(), 2), "class=\"group\""});
    row.push_back({shownNumber(pooled.std_ms(), 2)});
    row.push_back({shownNumber(pooled.max_ms, 0)});
  }
  return row;
}

}  // namespace

std::string companionTables(const BatchResults& batch) {
  return observedTable(batch) + toHtml(relationTable(batch));
}

std::string runTimeTable(const BatchResults& batch) {
  std::vector<std::string> timed;
  HtmlRow names{{"stage", "rowspan=\"2\""}}, units;
  for (std::size_t i = 0; i < batch.configurations.size(); ++i) {
    const std::string& name = batch.configurations[i];
    if (countOf(batch, name, [](const SceneResult& r) { return !r.times.empty(); }) == 0) continue;
    timed.push_back(name);
    names.push_back({lettered(batch, i), "colspan=\"3\" class=\"group\""});
    units.push_back({"mean ms", "class=\"group\""});
    units.push_back({"std ms"});
    units.push_back({"max ms"});
  }
  if (timed.empty()) return "";
  HtmlTable table{
      "run-time", "Run time of each stage per call, over all scenes.", {names, units}, {}};
  for (const StageName& stage : kStageNames) {
    HtmlRow row = runTimeRow(batch, timed, stage);
    (std::string(stage.key) == "total" ? table.summary : table.body).push_back(std::move(row));
  }
  return toHtml(table);
}

std::string problemTable(const BatchResults& batch) {
  HtmlTable table{"problems",
                  "Runs that failed, and what was repaired or left out.",
                  {{{"scene"}, {"configuration"}, {"status"}, {"what happened"}}},
                  {}};
  for (const SceneResult& result : batch.results) {
    const auto add = [&](const std::string& status, const std::string& what) {
      table.body.push_back({{escaped(result.scene)},
                            {escaped(result.configuration)},
                            {status},
                            {escaped(what), "class=\"text\""}});
    };
    if (result.run.status != RunStatus::kDone) add(nameOf(result.run.status), result.run.problem);
    if (result.run.status == RunStatus::kDone && !result.metrics && result.notes.empty())
      add("no truth", "nothing to compare with");
    for (const std::string& note : result.notes) add("note", note);
  }
  return table.body.empty() ? "" : toHtml(table);
}

}  // namespace occusg
