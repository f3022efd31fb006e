// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <optional>

#include "command_line.hpp"
#include "io/house_file.hpp"
#include "io/text_lines.hpp"
#include "output_file.hpp"
#include "output_place.hpp"

namespace occusg::apps {
namespace {

namespace po = boost::program_options;

CommandHelp truthHelp() {
  return {"occusg truth mp3d HOUSE -o FILE [options]",
          "Writes the annotated rooms of a Matterport3D .house file as rooms.json, as the paper's\n"
          "evaluation takes them: a room a region, its footprint the union of its floors and\n"
          "ceilings, on all levels and with all labels unless --level chooses one. Put FILE as\n"
          "rooms.json into the recording of the scene.\n\n"
          "  occusg truth mp3d 17DRP5sb8fy.house -o 17DRP5sb8fy/rooms.json\n",
          {"FORMAT", "HOUSE"}};
}

po::options_description truthOptions() {
  po::options_description options("Options");
  options.add_options()("output,o", po::value<std::string>()->required(),
                        "the rooms.json to write")("level", po::value<int>(),
                                                   "only regions of this level, counted from 0");
  return options;
}

}  // namespace

ExitCode truthCommand(const std::vector<std::string>& arguments) {
  const po::variables_map values = parse(arguments, truthHelp(), truthOptions());
  if (helpWasPrinted(values)) return kFine;
  const std::string format = values["FORMAT"].as<std::string>();
  if (format != "mp3d") throw UsageError("the format is '" + format + "'; allowed is mp3d");
  const auto level =
      values.count("level") > 0 ? std::optional<int>(values["level"].as<int>()) : std::nullopt;
  const std::string house = values["HOUSE"].as<std::string>();
  const std::string path = values["output"].as<std::string>();
  checkNotAnInput(path, {house});
  const HouseTruth truth = readHouse(house, level);
  OutputFile(path).write(toJson(truth.rooms));
  for (const std::string& note : truth.notes) std::cerr << "occusg: " << note << '\n';
  std::cout << counted(truth.rooms.rooms.size(), "room") << ", "
            << counted(truth.rooms.doors.size(), "door") << " in " << path << '\n';
  return kFine;
}

}  // namespace occusg::apps
