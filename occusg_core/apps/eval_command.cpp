// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <utility>

#include "batch_options.hpp"
#include "command_line.hpp"
#include "evaluation/truth_check.hpp"
#include "io/external_rooms.hpp"
#include "io/label_picture.hpp"
#include "occusg/error.hpp"
#include "occusg/evaluation/metrics_json.hpp"
#include "occusg/evaluation/room_metrics.hpp"
#include "occusg/io/rooms_file.hpp"
#include "output_file.hpp"

namespace occusg::apps {
namespace {

namespace po = boost::program_options;

CommandHelp evalHelp() {
  return {
      "occusg eval PREDICTED TRUTH [options]",
      "Compares predicted rooms with annotated ones. Each side is a rooms.json or a 16-bit grey\n"
      "PNG of room ids, its lower left corner at (0, 0), which takes --resolution.\n\n"
      "Rooms are matched one to one so that the sum of their intersections over unions (IoU)\n"
      "is largest; a match counts from an IoU of 0.15 (the paper's), 0.50 and 0.75.\n"
      "  R, P, F1   share of annotated rooms found, of predictions that are one, and both\n"
      "  mIoU, bF1  how well matched footprints and their outlines agree (0.25 m)\n"
      "  oS, uS     share of annotated rooms split, of predictions that merge several\n\n"
      "  occusg eval out/apartment/rooms.json examples/apartment/rooms.json\n"
      "  occusg eval out/plan/labels.png plan_truth.png --resolution 0.05\n",
      {"PREDICTED", "TRUTH"}};
}

po::options_description evalOptions() {
  po::options_description options("Options");
  options.add_options()("align", po::value<std::string>()->default_value("none"),
                        "how the truth is moved onto the prediction: none, centroid or search")(
      "resolution", po::value<double>(), "edge of a pixel of a PNG of room ids [m]")(
      "json", po::value<std::string>(), "also write all metrics to this file");
  return options;
}

bool isPicture(const std::string& path) {
  return std::filesystem::path(path).extension() == ".png";
}

std::vector<EvaluatedRoom> roomsOfPicture(const std::string& path,
                                          const po::variables_map& values) {
  if (values.count("resolution") == 0) {
    throw refuse(path, "says nothing of its scale",
                 "the metres of a pixel are needed (--resolution)");
  }
  std::vector<EvaluatedRoom> rooms;
  for (LabelledRoom& room : readLabelledRooms(path, values["resolution"].as<double>()))
    rooms.push_back({room.id, std::move(room.parts)});
  return rooms;
}

std::vector<EvaluatedRoom> roomsOfFile(const std::string& path) {
  std::vector<EvaluatedRoom> rooms;
  for (const RoomRecord& record : readExternalRooms(path, RingOrder::kAsWritten).rooms) {
    if (auto room = roomFrom(record.id, record.polygon, path)) {
      rooms.push_back(*std::move(room));
    } else {
      std::cerr << "occusg: " << path << ": room " << record.id
                << " encloses no area and is left out\n";
    }
  }
  return rooms;
}

std::vector<EvaluatedRoom> truthOfFile(const std::string& path) {
  std::vector<TruthRoom> rooms;
  for (const RoomRecord& record : readRooms(path, RingOrder::kAsWritten).rooms)
    rooms.push_back({record.id, record.polygon, record.level, record.further_parts});
  SoundTruth truth = soundTruth(rooms, path);
  for (const std::string& note : truth.notes) std::cerr << "occusg: " << note << '\n';
  return std::move(truth.rooms);
}

std::string shown(const std::optional<double>& value) {
  if (!value) return "-";
  std::ostringstream text;
  text << std::fixed << std::setprecision(3) << *value;
  return text.str();
}

void print(const RoomMetrics& metrics) {
  std::cout << "  " << metrics.n_truth << " annotated rooms, " << metrics.n_predicted
            << " predicted\n\n  IoU >=     R      P     F1   mIoU    bF1\n";
  for (const ThresholdMetrics& at : metrics.at) {
    std::cout << "  " << std::fixed << std::setprecision(2) << std::setw(6) << at.threshold;
    for (const auto& value :
         {std::optional<double>(at.recall), std::optional<double>(at.precision),
          std::optional<double>(at.f1), at.mean_iou, std::optional<double>(at.boundary_f1)})
      std::cout << std::setw(7) << shown(value);
    std::cout << '\n';
  }
  std::cout << "\n  oS " << shown(metrics.over_segmentation) << "  uS "
            << shown(metrics.under_segmentation) << "  severe under-segmentation "
            << (metrics.severe_under_segmentation ? "yes" : "no") << '\n';
}

}  // namespace

ExitCode evalCommand(const std::vector<std::string>& arguments) {
  const po::variables_map values = parse(arguments, evalHelp(), evalOptions());
  if (helpWasPrinted(values)) return kFine;

  RoomMetricsOptions metrics_options;
  metrics_options.alignment = alignmentNamed(values["align"].as<std::string>());
  const std::string predicted_path = values["PREDICTED"].as<std::string>();
  const std::string truth_path = values["TRUTH"].as<std::string>();
  const auto predicted = isPicture(predicted_path) ? roomsOfPicture(predicted_path, values)
                                                   : roomsOfFile(predicted_path);
  const auto truth =
      isPicture(truth_path) ? roomsOfPicture(truth_path, values) : truthOfFile(truth_path);
  const RoomMetrics metrics = evaluateRooms(predicted, truth, metrics_options);
  print(metrics);
  if (values.count("json") > 0) OutputFile(values["json"].as<std::string>()).write(toJson(metrics));
  return kFine;
}

}  // namespace occusg::apps
