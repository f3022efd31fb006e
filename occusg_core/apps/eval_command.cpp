// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "batch_options.hpp"
#include "command_line.hpp"
#include "evaluation/truth_check.hpp"
#include "io/external_rooms.hpp"
#include "io/label_picture.hpp"
#include "occusg/error.hpp"
#include "occusg/evaluation/room_metrics.hpp"
#include "occusg/io/rooms_file.hpp"
#include "output_file.hpp"
#include "output_place.hpp"
#include "storey_rooms.hpp"

namespace occusg::apps {
namespace {

namespace po = boost::program_options;

CommandHelp evalHelp() {
  return {
      "occusg eval PREDICTED TRUTH [options]",
      "Compares predicted rooms with annotated ones. Each side is a rooms.json or a 16-bit grey\n"
      "PNG of room ids, its lower left corner at (0, 0), which takes --resolution.\n\n"
      "Rooms of different storeys are matched apart, a predicted storey with the annotated one\n"
      "whose floor is at most 1 m from its own.\n\n"
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

std::vector<RoomOnStorey> roomsOfPicture(const std::string& path, const po::variables_map& values) {
  if (values.count("resolution") == 0) {
    throw refuse(path, "says nothing of its scale",
                 "the metres of a pixel are needed (--resolution)");
  }
  std::vector<RoomOnStorey> rooms;
  for (LabelledRoom& room : readLabelledRooms(path, values["resolution"].as<double>()))
    rooms.push_back({{room.id, std::move(room.parts)}, 0.0});
  return rooms;
}

/// Height of the floor of the storey with the id; the file's where it names no storeys.
double floorOf(const RoomsFile& file, int storey) {
  for (const StoreyRecord& record : file.storeys)
    if (record.id == storey) return record.floor_z_m;
  return file.floor_z_m;
}

std::vector<RoomOnStorey> roomsOfFile(const std::string& path) {
  std::vector<RoomOnStorey> rooms;
  const RoomsFile file = readExternalRooms(path, RingOrder::kAsWritten);
  for (const RoomRecord& record : file.rooms) {
    if (auto room = roomFrom(record.id, record.polygon, path)) {
      rooms.push_back({*std::move(room), floorOf(file, record.level)});
    } else {
      std::cerr << "occusg: " << path << ": room " << record.id
                << " encloses no area and is left out\n";
    }
  }
  return rooms;
}

std::vector<RoomOnStorey> truthOfFile(const std::string& path) {
  std::vector<TruthRoom> rooms;
  const RoomsFile file = readRooms(path, RingOrder::kAsWritten);
  std::map<int, double> floors;
  for (const RoomRecord& record : file.rooms) {
    rooms.push_back({record.id, record.polygon, record.level, record.further_parts});
    floors[record.id] = floorOf(file, record.level);
  }
  SoundTruth truth = soundTruth(rooms, path);
  for (const std::string& note : truth.notes) std::cerr << "occusg: " << note << '\n';
  std::vector<RoomOnStorey> sound;
  for (EvaluatedRoom& room : truth.rooms) {
    const double floor_z_m = floors[room.id];
    sound.push_back({std::move(room), floor_z_m});
  }
  return sound;
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

void print(const StoreyRooms& storey, const RoomMetricsOptions& options) {
  std::cout << "  storey at " << std::fixed << std::setprecision(2) << storey.floor_z_m << " m: ";
  if (!storey.is_annotated) {
    std::cout << "predicted rooms: " << storey.predicted.size() << ", none annotated there\n";
    return;
  }
  const RoomMetrics metrics = evaluateRooms(storey.predicted, storey.truth, options);
  std::cout << "annotated rooms: " << metrics.n_truth << ", predicted: " << metrics.n_predicted
            << ", F1";
  for (const ThresholdMetrics& at : metrics.at) {
    std::cout << "  " << std::setprecision(3) << at.f1 << " at " << std::setprecision(2)
              << at.threshold;
  }
  std::cout << '\n';
}

std::vector<EvaluatedRoom> roomsOf(const std::vector<RoomOnStorey>& rooms) {
  std::vector<EvaluatedRoom> all;
  all.reserve(rooms.size());
  for (const RoomOnStorey& room : rooms) all.push_back(room.room);
  return all;
}

/// Rooms are matched storey by storey where the truth has more than one.
RoomMetrics evaluated(const std::vector<RoomOnStorey>& predicted,
                      const std::vector<RoomOnStorey>& truth, const RoomMetricsOptions& options) {
  std::set<double> floors;
  for (const RoomOnStorey& room : truth) floors.insert(room.floor_z_m);
  if (floors.size() < 2) return evaluateRooms(roomsOf(predicted), roomsOf(truth), options);
  const std::vector<StoreyRooms> storeys = byStorey(predicted, truth);
  for (const StoreyRooms& storey : storeys) print(storey, options);
  const StoreyRooms all = sideBySide(storeys);
  return evaluateRooms(all.predicted, all.truth, options);
}

bool overlap(const std::vector<RoomOnStorey>& predicted, const std::vector<RoomOnStorey>& truth) {
  return std::any_of(predicted.begin(), predicted.end(), [&](const RoomOnStorey& a) {
    return std::any_of(truth.begin(), truth.end(), [&](const RoomOnStorey& b) {
      return intersectionArea(a.room, b.room) > 0.0;
    });
  });
}

/// Two sides of different frames get zeros everywhere, as bad predictions do.
void tellWhenApart(const std::vector<RoomOnStorey>& predicted,
                   const std::vector<RoomOnStorey>& truth, const po::variables_map& values) {
  const bool may_be_moved = values["align"].as<std::string>() != "none";
  if (may_be_moved || predicted.empty() || truth.empty() || overlap(predicted, truth)) return;
  std::cerr << "occusg: no predicted room overlaps an annotated one: are both sides in the same "
               "frame? A PNG lies with its lower left corner at (0, 0); --align moves the truth\n";
}

/// @throws UsageError for a scale that nothing is read with.
void checkScale(const po::variables_map& values, const std::vector<std::string>& paths) {
  if (values.count("resolution") == 0 || std::any_of(paths.begin(), paths.end(), isPicture)) return;
  throw UsageError("--resolution is that of a PNG of room ids, but neither side is a PNG");
}

}  // namespace

ExitCode evalCommand(const std::vector<std::string>& arguments) {
  const po::variables_map values = parse(arguments, evalHelp(), evalOptions());
  if (helpWasPrinted(values)) return kFine;

  RoomMetricsOptions metrics_options;
  metrics_options.alignment = alignmentNamed(values["align"].as<std::string>());
  const std::string predicted_path = values["PREDICTED"].as<std::string>();
  const std::string truth_path = values["TRUTH"].as<std::string>();
  checkScale(values, {predicted_path, truth_path});
  const auto json_path = given<std::string>(values, "json");
  if (json_path) checkNotAnInput(*json_path, {predicted_path, truth_path});
  const auto predicted = isPicture(predicted_path) ? roomsOfPicture(predicted_path, values)
                                                   : roomsOfFile(predicted_path);
  const auto truth =
      isPicture(truth_path) ? roomsOfPicture(truth_path, values) : truthOfFile(truth_path);
  tellWhenApart(predicted, truth, values);
  const RoomMetrics metrics = evaluated(predicted, truth, metrics_options);
  print(metrics);
  if (json_path) OutputFile(*json_path).write(toJson(metrics));
  return kFine;
}

}  // namespace occusg::apps
