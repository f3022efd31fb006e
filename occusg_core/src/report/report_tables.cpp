// SPDX-License-Identifier: BSD-3-Clause
#include "report/report_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "evaluation/score_estimates.hpp"
#include "report/html_text.hpp"
#include "report/report_cells.hpp"

namespace occusg {
namespace {

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
  if (columns > 1) return {names, letters};
  HtmlRow single{{"scene"}, {"GT"}};
  for (const std::string& group : groups) single.push_back({group, "class=\"group\""});
  return {single};
}

HtmlTable sceneTable(const BatchResults& batch, std::size_t threshold, const std::string& shown) {
  const std::vector<Measure> measures = tableOneMeasures();
  std::vector<std::string> groups;
  groups.reserve(measures.size());
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

}  // namespace

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

}  // namespace occusg
