// SPDX-License-Identifier: BSD-3-Clause
#include "report/report_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "occusg/evaluation/score_estimates.hpp"
#include "report/html_text.hpp"

namespace occusg {
namespace {

std::string spanning(std::size_t columns) { return "colspan=\"" + std::to_string(columns) + "\""; }

std::string lettered(const BatchResults& batch, std::size_t configuration) {
  return "<b class=\"letter\">" + letterOf(configuration) + "</b> " +
         escaped(batch.configurations[configuration]);
}

HtmlCell estimateCell(const Estimate& estimate) {
  std::string html = shownShare(estimate.value);
  if (estimate.confidence_95) {
    html += "<small>" + shownShare(estimate.confidence_95->low) + "–" +
            shownShare(estimate.confidence_95->high) + "</small>";
  }
  return {html};
}

std::size_t countOf(const BatchResults& batch, const std::string& configuration,
                    const std::function<bool(const SceneResult&)>& holds) {
  return static_cast<std::size_t>(
      std::count_if(batch.results.begin(), batch.results.end(), [&](const SceneResult& result) {
        return result.configuration == configuration && holds(result);
      }));
}

bool hasFailed(const SceneResult& result) {
  return result.run.status == RunStatus::kFailed || result.run.status == RunStatus::kTimedOut;
}

/// "9", or "8 + 1 failed".
std::string scenesCell(const BatchResults& batch, const std::string& name) {
  const std::size_t failed = countOf(
      batch, name, [](const SceneResult& r) { return r.metrics.has_value() && hasFailed(r); });
  const std::size_t scored =
      countOf(batch, name, [](const SceneResult& r) { return r.metrics.has_value(); });
  if (failed == 0) return std::to_string(scored);
  return std::to_string(scored - failed) + " + " + std::to_string(failed) + " failed";
}

HtmlTable summaryTable(const BatchResults& batch, Averaging averaging) {
  const bool is_macro = averaging == Averaging::kMacro;
  HtmlTable table{is_macro ? "macro" : "micro",
                  is_macro ? "Macro averages: every scene counts the same, as in the paper."
                           : "Micro averages: every room counts the same.",
                  {{{"configuration"},
                    {"scenes"},
                    {"R"},
                    {"P"},
                    {"F1"},
                    {"mIoU"},
                    {"bF1"},
                    {"F1 at .50"},
                    {"F1 at .75"},
                    {"oS"},
                    {"uS"},
                    {"severe"}}},
                  {}};
  for (std::size_t i = 0; i < batch.configurations.size(); ++i) {
    const std::string& name = batch.configurations[i];
    const std::vector<RoomMetrics> metrics = metricsOf(batch, name);
    HtmlRow row{{lettered(batch, i)}, {scenesCell(batch, name)}};
    const ScoreEstimates scores = estimate(metrics, averaging);
    if (scores.at.size() == 3) {
      const ThresholdEstimates& main = scores.at[0];
      for (const Estimate& value :
           {main.recall, main.precision, main.f1, main.mean_iou, main.boundary_f1, scores.at[1].f1,
            scores.at[2].f1, scores.over_segmentation, scores.under_segmentation})
        row.push_back(estimateCell(value));
      const auto severe = std::count_if(metrics.begin(), metrics.end(), [](const RoomMetrics& m) {
        return m.severe_under_segmentation;
      });
      row.push_back({std::to_string(severe) + "/" + std::to_string(metrics.size())});
    } else {
      row.push_back({"no scene with a prediction and a truth", spanning(10)});
    }
    table.body.push_back(std::move(row));
  }
  return table;
}

double f1At(const SceneResult& result, std::size_t threshold) {
  return result.metrics->at[threshold].f1;
}

/// Differences to the first configuration over the scenes both have.
std::string differenceTable(const BatchResults& batch) {
  if (batch.configurations.size() < 2) return "";
  HtmlTable table{"difference",
                  "Gain in F1 over <b class=\"letter\">A</b>, scene by scene. An interval without "
                  "zero (bold) is not chance.",
                  {{{"configuration"}, {"scenes"}, {"F1 at .15"}, {"F1 at .50"}, {"F1 at .75"}}},
                  {}};
  for (std::size_t i = 1; i < batch.configurations.size(); ++i) {
    std::array<std::vector<double>, 3> first, other;
    for (const std::string& scene : batch.scenes) {
      const SceneResult* a = resultOf(batch, batch.configurations.front(), scene);
      const SceneResult* b = resultOf(batch, batch.configurations[i], scene);
      if (a == nullptr || b == nullptr || !a->metrics || !b->metrics) continue;
      for (std::size_t t = 0; t < 3; ++t) {
        first[t].push_back(f1At(*a, t));
        other[t].push_back(f1At(*b, t));
      }
    }
    HtmlRow row{{lettered(batch, i)}, {std::to_string(first[0].size())}};
    for (std::size_t t = 0; t < 3; ++t) {
      const Estimate gain = pairedDifference(first[t], other[t]);
      const auto& interval = gain.confidence_95;
      std::string html = gain.value ? shownDifference(*gain.value) : "–";
      if (interval) {
        html += "<small>" + shownDifference(interval->low) + " to " +
                shownDifference(interval->high) + "</small>";
      }
      const bool is_sure = interval && interval->low * interval->high > 0.0;
      row.push_back({html, is_sure ? "class=\"best\"" : ""});
    }
    table.body.push_back(std::move(row));
  }
  return toHtml(table);
}

using ThresholdValue = std::function<std::optional<double>(const ThresholdMetrics&)>;

struct Measure {
  const char* name;
  ThresholdValue value;
};

std::vector<Measure> tableOneMeasures() {
  return {{"R", [](const ThresholdMetrics& at) { return at.recall; }},
          {"P", [](const ThresholdMetrics& at) { return at.precision; }},
          {"F1", [](const ThresholdMetrics& at) { return at.f1; }},
          {"mIoU", [](const ThresholdMetrics& at) { return at.mean_iou; }},
          {"bF1", [](const ThresholdMetrics& at) { return at.boundary_f1; }}};
}

/// Bold where one value is above all others; ties are not bold.
void markBest(const std::vector<std::optional<double>>& values, HtmlRow& row) {
  const std::size_t start = row.size() - values.size();
  const auto shown = [](const std::optional<double>& value) { return value ? *value : -1.0; };
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool is_best = values.size() > 1 && values[i] &&
                         std::none_of(values.begin(), values.end(), [&](const auto& other) {
                           return &other != &values[i] && shown(other) > *values[i] - 0.0005;
                         });
    if (is_best) row[start + i].attributes += "class=\"best\"";
    if (i == 0) row[start + i].attributes = is_best ? "class=\"best group\"" : "class=\"group\"";
  }
}

HtmlCell truthCountCell(const BatchResults& batch, const std::string& scene) {
  for (const std::string& name : batch.configurations) {
    const SceneResult* result = resultOf(batch, name, scene);
    if (result != nullptr && result->metrics) return {std::to_string(result->metrics->n_truth)};
  }
  return {"–"};
}

std::vector<HtmlRow> sideBySideHeader(const BatchResults& batch,
                                      const std::vector<std::string>& groups) {
  const std::size_t columns = batch.configurations.size();
  HtmlRow names{{"scene", "rowspan=\"2\""}, {"GT", "rowspan=\"2\""}};
  HtmlRow letters;
  for (const std::string& group : groups) {
    names.push_back({group, spanning(columns) + " class=\"group\""});
    for (std::size_t i = 0; i < columns; ++i)
      letters.push_back({letterOf(i), i == 0 ? "class=\"group\"" : ""});
  }
  if (columns == 1)
    return {[&] {
      HtmlRow single{{"scene"}, {"GT"}};
      for (const std::string& group : groups) single.push_back({group, "class=\"group\""});
      return single;
    }()};
  return {names, letters};
}

HtmlTable sceneTable(const BatchResults& batch, std::size_t threshold, const std::string& shown) {
  const std::vector<Measure> measures = tableOneMeasures();
  std::vector<std::string> groups;
  for (const Measure& measure : measures) groups.emplace_back(measure.name);
  HtmlTable table{"scenes-" + shown.substr(1),
                  "Rooms found at an IoU of at least " + shown + ".",
                  sideBySideHeader(batch, groups),
                  {}};
  for (const std::string& scene : batch.scenes) {
    HtmlRow row{{escaped(scene)}, truthCountCell(batch, scene)};
    for (const Measure& measure : measures) {
      std::vector<std::optional<double>> values;
      for (const std::string& name : batch.configurations) {
        const SceneResult* result = resultOf(batch, name, scene);
        const bool is_known = result != nullptr && result->metrics;
        values.push_back(is_known ? measure.value(result->metrics->at[threshold]) : std::nullopt);
        row.push_back({shownShare(values.back())});
      }
      markBest(values, row);
    }
    table.body.push_back(std::move(row));
  }
  HtmlRow mean{{"macro mean"}, {""}};
  for (const Measure& measure : measures) {
    std::vector<std::optional<double>> values;
    for (const std::string& name : batch.configurations) {
      const RoomMetricsMean of_scenes = macroMean(metricsOf(batch, name));
      values.push_back(of_scenes.at.empty() ? std::nullopt
                                            : measure.value(of_scenes.at[threshold]));
      mean.push_back({shownShare(values.back())});
    }
    markBest(values, mean);
  }
  table.summary.push_back(std::move(mean));
  return table;
}

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

std::string letterOf(std::size_t configuration) {
  const std::string letter(1, static_cast<char>('A' + configuration % 26));
  return configuration < 26 ? letter : letter + std::to_string(configuration / 26);
}

std::string summaryTables(const BatchResults& batch) {
  return toHtml(summaryTable(batch, Averaging::kMacro)) +
         toHtml(summaryTable(batch, Averaging::kMicro)) + differenceTable(batch);
}

std::string sceneTables(const BatchResults& batch) {
  return toHtml(sceneTable(batch, 0, ".15")) + toHtml(sceneTable(batch, 1, ".50")) +
         toHtml(sceneTable(batch, 2, ".75"));
}

std::string segmentationTable(const BatchResults& batch) {
  HtmlTable table{"segmentation",
                  "Rooms found, over-segmentation (share of annotated rooms split), "
                  "under-segmentation (share of predictions that merge), severe "
                  "under-segmentation.",
                  sideBySideHeader(batch, {"found", "oS", "uS", "severe"}),
                  {}};
  for (const std::string& scene : batch.scenes) {
    HtmlRow row{{escaped(scene)}, truthCountCell(batch, scene)};
    const auto add = [&](const std::function<std::string(const RoomMetrics&)>& shown) {
      for (std::size_t i = 0; i < batch.configurations.size(); ++i) {
        const SceneResult* result = resultOf(batch, batch.configurations[i], scene);
        const bool is_known = result != nullptr && result->metrics;
        row.push_back({is_known ? shown(*result->metrics) : "–", i == 0 ? "class=\"group\"" : ""});
      }
    };
    add([](const RoomMetrics& m) { return std::to_string(m.n_predicted); });
    add([](const RoomMetrics& m) { return shownShare(m.over_segmentation); });
    add([](const RoomMetrics& m) { return shownShare(m.under_segmentation); });
    add([](const RoomMetrics& m) {
      return std::string(m.severe_under_segmentation ? "yes" : "no");
    });
    table.body.push_back(std::move(row));
  }
  return toHtml(table);
}

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
