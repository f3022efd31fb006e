// SPDX-License-Identifier: BSD-3-Clause
#include "batch_results.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "batch_options.hpp"
#include "io/file_bytes.hpp"
#include "occusg/error.hpp"
#include "occusg/io/output_folder.hpp"
#include "report/report_page.hpp"
#include "report/results_files.hpp"

namespace occusg::apps {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kFormat = "occusg-batch";
constexpr std::size_t kMaxIndexBytes = std::size_t{16} << 20U;

void appendNew(const std::vector<std::string>& names, std::vector<std::string>& all) {
  for (const std::string& name : names)
    if (std::find(all.begin(), all.end(), name) == all.end()) all.push_back(name);
}

/// The scene's files from the first folder in which it was run.
SceneFiles filesOf(const std::vector<std::string>& folders, const std::string& configuration,
                   const std::string& scene) {
  SceneFiles none;
  none.configuration = configuration;
  none.scene = scene;
  none.run.problem = "not run yet";
  for (const std::string& folder : folders) {
    const std::string path = sceneFolder(folder, configuration, scene);
    std::error_code ignored;
    if (fs::exists(fs::path(path) / "run.json", ignored))
      return readSceneFolder(path, configuration, scene);
  }
  return none;
}

std::string shown(const std::optional<double>& value) {
  if (!value) return "    -";
  char text[32];
  std::snprintf(text, sizeof text, "%5.3f", *value);
  return text;
}

void printAverages(const BatchResults& batch) {
  std::size_t width = 13;
  for (const std::string& name : batch.configurations) width = std::max(width, name.size());
  const int columns = static_cast<int>(width);
  // The paper's Table 2, and F1 at .50.
  std::printf(
      "\n%-*s  scenes   Pred      M      R      P     F1   mIoU mIoU_GT   bF1 F1@.50  severe\n",
      columns, "configuration");
  for (const std::string& name : batch.configurations) {
    const RoomMetricsMean mean = macroMean(metricsOf(batch, name));
    if (mean.at.size() < 2) {
      std::printf("%-*s  %6d   no scene with a prediction and a truth\n", columns, name.c_str(), 0);
      continue;
    }
    const ThresholdMetrics& at = mean.at.front();
    const double severe = mean.severe_under_segmentation * static_cast<double>(mean.n_scenes);
    std::printf("%-*s  %6zu %6.2f %6.2f  %s  %s  %s  %s   %s %s  %s    %.0f/%zu\n", columns,
                name.c_str(), mean.n_scenes, mean.n_predicted, at.matches, shown(at.recall).c_str(),
                shown(at.precision).c_str(), shown(at.f1).c_str(), shown(at.mean_iou).c_str(),
                shown(at.mean_iou_gt).c_str(), shown(at.boundary_f1).c_str(),
                shown(mean.at[1].f1).c_str(), severe, mean.n_scenes);
  }
}

}  // namespace

std::string toJson(const BatchIndex& index) {
  return json{{"format", kFormat},
              {"version", 1},
              {"configurations", index.configurations},
              {"scenes", index.scenes},
              {"alignment", index.alignment},
              {"title", index.title}}
             .dump(1) +
         "\n";
}

BatchIndex readBatchIndex(const std::string& folder) {
  const std::string path = (fs::path(folder) / "batch.json").string();
  try {
    const json document = json::parse(readFile(path, kMaxIndexBytes));
    if (document.at("format") != kFormat || document.at("version") != 1)
      throw refuse(path, "is of another format", "the output of 'occusg batch' is needed");
    BatchIndex index{document.at("configurations").get<std::vector<std::string>>(),
                     document.at("scenes").get<std::vector<std::string>>(),
                     document.at("alignment").get<std::string>(),
                     document.at("title").get<std::string>()};
    (void)alignmentNamed(index.alignment);
    return index;
  } catch (const json::exception& error) {
    throw refuse(path, std::string("cannot be used (") + error.what() + ")",
                 "the output of 'occusg batch' is needed");
  }
}

std::string sceneFolder(const std::string& out, const std::string& configuration,
                        const std::string& scene) {
  return (fs::path(out) / configuration / scene).string();
}

BatchResults collectResults(const std::vector<std::string>& folders) {
  BatchResults batch;
  for (const std::string& folder : folders) {
    const BatchIndex index = readBatchIndex(folder);
    appendNew(index.configurations, batch.configurations);
    appendNew(index.scenes, batch.scenes);
    if (!batch.alignment.empty() && batch.alignment != index.alignment) {
      throw refuse(folder, "was run with --align " + index.alignment,
                   batch.alignment + " as in " + folders.front() + " is needed");
    }
    batch.alignment = index.alignment;
  }
  RoomMetricsOptions options;
  options.alignment = alignmentNamed(batch.alignment);
  for (const std::string& scene : batch.scenes) {
    std::vector<SceneFiles> runs;
    std::optional<SeenFloor> seen_floor;
    for (const std::string& configuration : batch.configurations) {
      runs.push_back(filesOf(folders, configuration, scene));
      if (!seen_floor) seen_floor = runs.back().seen_floor;
    }
    for (const SceneFiles& run : runs)
      batch.results.push_back(evaluateScene(run, options, seen_floor));
  }
  return batch;
}

void writeResults(const BatchResults& batch, const std::string& title, const std::string& out) {
  const OutputFolder folder(out);
  folder.write("results.csv", toCsv(batch));
  folder.write("results.json", toJson(batch));
  folder.write("report.html", reportPage(batch, title));
  printAverages(batch);
  std::printf("\nThe report is %s\n", (fs::path(out) / "report.html").c_str());
}

ExitCode reportFailures(const BatchResults& batch) {
  ExitCode code = kFine;
  for (const SceneResult& result : batch.results) {
    if (result.run.status != RunStatus::kFailed && result.run.status != RunStatus::kTimedOut)
      continue;
    std::cerr << "occusg: " << result.configuration << "/" << result.scene << " "
              << nameOf(result.run.status) << ": " << result.run.problem << '\n';
    code = kFailed;
  }
  return code;
}

}  // namespace occusg::apps
