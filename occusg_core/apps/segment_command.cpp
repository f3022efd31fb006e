// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <locale>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "io/decomposition_drawing.hpp"
#include "io/label_picture.hpp"
#include "io/overview_picture.hpp"
#include "io/rooms_geojson.hpp"
#include "occusg/error.hpp"
#include "occusg/io/map_reader.hpp"
#include "occusg/io/output_folder.hpp"
#include "occusg/io/results.hpp"
#include "occusg/pipeline/config_file.hpp"
#include "occusg/regions/no_rooms.hpp"
#include "output_file.hpp"
#include "output_place.hpp"
#include "room_table.hpp"

namespace occusg::apps {
namespace {

namespace po = boost::program_options;

CommandHelp segmentHelp() {
  return {
      "occusg segment MAP -o OUT [options]",
      "Cuts a finished 2D map into rooms.\n\n"
      "MAP is a map_server YAML file, or a picture alone (PNG, PGM, PPM, PBM, BMP or JPEG), which "
      "takes --resolution;\n"
      "its lower left corner is then (0, 0), x right, y up. A pixel v is occupied with "
      "probability\n"
      "(255 - v) / 255; free are cells below the free threshold, the rest bounds rooms. The\n"
      "options go before what the YAML says.\n\n"
      "OUT receives rooms.json, rooms.geojson, labels.png (room ids, 16 bit, of the map's size) "
      "with\n"
      "labels.yaml, overview.png and timing.json. Where a map leaves open how it is meant, a line\n"
      "says what was assumed.\n\n"
      "  occusg segment map.yaml -o out/map\n"
      "  occusg segment plan.png -o out/plan --resolution 0.05 --d-thr 1.5\n",
      {"MAP"}};
}

po::options_description segmentOptions() {
  po::options_description options("Options");
  addOutputOption(options);
  addConfigOption(options);
  addDecomposerOption(options);
  options.add_options()(
      "d-thr", po::value<std::string>(),
      "overrides regions.dude.depth_threshold_m [m]; the decomposer is then dude")(
      "resolution", po::value<double>(), "edge of a pixel [m]")(
      "origin", po::value<std::string>(), "X,Y: lower left corner of the picture [m]")(
      "occupied-thresh", po::value<double>(),
      "occupied above this probability (without YAML: 0.65)")(
      "free-thresh", po::value<double>(), "free below this probability (without YAML: 0.196)")(
      "negate", "dark pixels are free")("mode", po::value<std::string>(),
                                        "trinary, scale or raw (without YAML: trinary)")(
      "strict", "what the map leaves open is an error, not an assumption")(
      "max-cells", po::value<std::int64_t>()->default_value(kDefaultMaxMapCells),
      "larger maps are refused")(
      "debug-drawing", po::value<std::string>(),
      "PNG that shows how dude found its cuts; the decomposer, and the rooms, are then dude's");
  return options;
}

MapMode modeNamed(const std::string& name) {
  if (name == "trinary") return MapMode::kTrinary;
  if (name == "scale") return MapMode::kScale;
  if (name == "raw") return MapMode::kRaw;
  throw UsageError("--mode is '" + name + "'; allowed is trinary, scale or raw");
}

Point2 pointIn(const std::string& text) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  Point2 point;
  char comma = ' ';
  if (!(stream >> point.x >> comma >> point.y) || comma != ',' ||
      stream.peek() != std::istringstream::traits_type::eof())
    throw UsageError("--origin is '" + text + "'; allowed is X,Y in metres");
  return point;
}

std::size_t maxCellsFrom(std::int64_t count) {
  if (count < 1 || count > static_cast<std::int64_t>(kMaxMapCells)) {
    throw UsageError("--max-cells is " + std::to_string(count) + "; a number from 1 to " +
                     std::to_string(kMaxMapCells) + " is needed");
  }
  return static_cast<std::size_t>(count);
}

/// Where the drawing goes, if one is wanted.
std::optional<std::string> drawingPath(const po::variables_map& values) {
  auto path = given<std::string>(values, "debug-drawing");
  if (path && std::filesystem::path(*path).extension() != ".png")
    throw UsageError("--debug-drawing is '" + *path + "'; a name that ends in .png is needed");
  return path;
}

MapReaderOptions readerOptionsFrom(const po::variables_map& values) {
  MapReaderOptions options;
  options.resolution_m = given<double>(values, "resolution");
  options.occupied_threshold = given<double>(values, "occupied-thresh");
  options.free_threshold = given<double>(values, "free-thresh");
  options.max_cells = maxCellsFrom(values["max-cells"].as<std::int64_t>());
  if (values.count("negate") > 0) options.polarity = MapPolarity::kDarkIsFree;
  if (const auto mode = given<std::string>(values, "mode")) options.mode = modeNamed(*mode);
  if (const auto origin = given<std::string>(values, "origin")) options.origin = pointIn(*origin);
  return options;
}

PipelineConfig configFrom(const po::variables_map& values) {
  PipelineConfig config = givenConfig(values);
  const bool wants_dude = values.count("d-thr") + values.count("debug-drawing") > 0;
  // Who asks for a drawing does not ask for other rooms.
  const bool is_changed = values.count("d-thr") + values.count("decomposer") == 0 && wants_dude &&
                          config.decomposer != DecomposerKind::kDude;
  if (is_changed) {
    std::cerr << "occusg: --debug-drawing draws the steps of the decomposer dude, so the rooms are "
                 "those of dude\n";
  }
  if (wants_dude) config.decomposer = DecomposerKind::kDude;
  config = overridden(config, values, "decomposer", "regions.decomposer");
  config = overridden(config, values, "d-thr", "regions.dude.depth_threshold_m");
  if (config.decomposer == DecomposerKind::kDude) return config;
  for (const std::string option : {"d-thr", "debug-drawing"}) {
    if (values.count(option) > 0) {
      throw refuse("--" + option, "means something to the dude decomposer only",
                   "leave '--decomposer' out or make it dude");
    }
  }
  return config;
}

RoomsFile roomsOf(const Decomposition& decomposition, const GridMap& map) {
  RoomsFile rooms;
  rooms.scene = map.name;
  for (const Region& region : decomposition.regions) {
    rooms.rooms.push_back({region.id, "unknown", map.in_map(region.polygon)});
  }
  for (const Crossing& crossing : decomposition.crossings) {
    rooms.doors.push_back({crossing.region_a,
                           crossing.region_b,
                           {map.in_map(crossing.segment.a), map.in_map(crossing.segment.b)}});
  }
  return rooms;
}

std::string overviewPng(const GridMap& map, const Decomposition& decomposition) {
  GridMap unmoved = map;
  unmoved.in_map = {};
  const RoomsFile rooms = roomsOf(decomposition, unmoved);
  return encodePng(drawOverview(map.free_space, {map.name, rooms.rooms, rooms.doors, {}}),
                   effortFor(rooms.rooms.size()));
}

std::string drawingPng(const Decomposer& decomposer, const Decomposition& decomposition,
                       const GridMap& map, const PipelineConfig& config) {
  const auto& dude = dynamic_cast<const DudeDecomposer&>(decomposer);
  return encodePng(drawDecomposition(map.free_space, decomposition, dude.trace(),
                                     config.dude.depth_threshold_m, map.name));
}

/// Where labels.png lies in the map frame, as map_server says it.
std::string labelsYaml(const GridMap& map) {
  const Point2 origin = map.in_map(map.free_space.frame.corner(map.free_space.cells.box().min));
  std::ostringstream yaml;
  yaml.imbue(std::locale::classic());
  constexpr int kDigits = 9;
  yaml.precision(kDigits);
  yaml << "# Pixel values are room ids, 0 for no room.\nimage: labels.png\nresolution: "
       << map.free_space.frame.resolution_m << "\norigin: [" << origin.x << ", " << origin.y << ", "
       << map.in_map.yaw_rad
       << "]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\nmode: raw\n";
  return yaml.str();
}

/// Says what was assumed; @throws Error instead when `strict`.
void tellAssumptions(const GridMap& map, const std::string& path, bool strict) {
  for (const std::string& assumption : map.assumptions) {
    if (strict) {
      throw refuse(path, "leaves something open: " + assumption,
                   "without --strict this is assumed");
    }
    std::cerr << "occusg: " << path << ": " << assumption << '\n';
  }
}

/// The results must not take the place of the map, nor of a session.
void checkPlace(const std::string& output, const std::optional<std::string>& drawing,
                const GridMap& map, const std::string& path) {
  const std::vector<std::string> inputs{path, map.picture_path};
  checkNotInputs(output,
                 {"rooms.json", "rooms.geojson", "labels.yaml", "labels.png", "timing.json",
                  "overview.png", "files.json"},
                 inputs);
  if (drawing) checkNotAnInput(*drawing, inputs);
  checkResultsPlace(output);
}

}  // namespace

ExitCode segmentCommand(const std::vector<std::string>& arguments) {
  const po::variables_map values = parse(arguments, segmentHelp(), segmentOptions());
  if (helpWasPrinted(values)) return kFine;

  const auto drawing_path = drawingPath(values);
  const PipelineConfig config = configFrom(values);
  const std::unique_ptr<Decomposer> decomposer = makeDecomposer(config);
  StageTimes times;
  const GridMap map = readMap(values["MAP"].as<std::string>(), readerOptionsFrom(values));
  tellAssumptions(map, values["MAP"].as<std::string>(), values.count("strict") > 0);
  checkPlace(values["output"].as<std::string>(), drawing_path, map,
             values["MAP"].as<std::string>());
  const OutputFolder folder(values["output"].as<std::string>());
  std::optional<OutputFile> drawing;
  if (drawing_path) drawing.emplace(*drawing_path);

  const Decomposition* found = nullptr;
  const RoomsFile rooms = timed(times, Stage::kTotal, [&] {
    found = &timed(times, Stage::kDecomposition,
                   [&]() -> const Decomposition& { return decomposer->update(map.free_space); });
    return roomsOf(*found, map);
  });
  const Decomposition& decomposition = *found;
  times.setMemory(Stage::kFreeSpace, map.free_space.cells.memoryBytes());
  times.setMemory(Stage::kDecomposition,
                  decomposition.labels.values().size() * sizeof(std::int32_t));
  setPeakMemory(times);

  const std::vector<ResultFile> files = {
      {"rooms.json", toJson(rooms)},
      {"rooms.geojson", toGeoJson(rooms)},
      {"labels.yaml", labelsYaml(map)},
      {"labels.png", labelPng(decomposition.labels, map.free_space.cells.box())},
      {"timing.json", timingJson(times)},
      {"overview.png", overviewPng(map, decomposition)}};
  writeResultFiles(folder, files);
  if (drawing) drawing->write(drawingPng(*decomposer, decomposition, map, config));

  printRooms(rooms);
  if (rooms.rooms.empty()) {
    std::cerr << "occusg: no rooms: " << whyNoRooms(map.free_space, smallestRegion_m2(config))
              << '\n';
  }
  printTimes(times);
  std::cout << "\nResults are in " << folder.path() << '\n';
  return kFine;
}

}  // namespace occusg::apps
