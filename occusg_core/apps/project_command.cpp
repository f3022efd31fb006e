// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "io/overview_picture.hpp"
#include "io/text_lines.hpp"
#include "mapping/layer_without_rays.hpp"
#include "occusg/error.hpp"
#include "occusg/io/map_files.hpp"
#include "occusg/io/octomap_file.hpp"
#include "occusg/io/output_folder.hpp"
#include "occusg/io/results.hpp"
#include "occusg/mapping/free_space_layer.hpp"
#include "occusg/pipeline/config_file.hpp"

namespace occusg::apps {
namespace {

namespace po = boost::program_options;

CommandHelp projectHelp() {
  return {"occusg project MAP -o OUT [options]",
          "Makes the 2D free-space layer of a saved OctoMap (.bt or .ot, OcTree or ColorOcTree).\n"
          "The resolution is the file's; everything else of mapping.free_space in the\n"
          "configuration holds, such as which heights count.\n\n"
          "A map made from a point cloud has no free voxel: its walls are drawn as obstacles, and\n"
          "--unknown-is-free makes free what they enclose.\n\n"
          "OUT receives free_space.pgm and .yaml, as map_server and 'occusg segment' read them,\n"
          "and overview.png.\n\n"
          "  occusg project building.bt -o out/building\n"
          "  occusg segment out/building/free_space.yaml -o out/building_rooms\n",
          {"MAP"}};
}

po::options_description projectOptions() {
  po::options_description options("Options");
  addOutputOption(options);
  addConfigOption(options);
  options.add_options()("unknown-is-free",
                        "in a map without free voxels, what obstacles enclose is free")(
      "strict", "a map that needs an assumption is an error");
  return options;
}

OccupancyMapConfig configFor(const OctomapHeader& header, const PipelineConfig& config) {
  OccupancyMapConfig fitted = config.occupancy;
  fitted.resolution_m = header.resolution_m;
  // Nothing will be inserted; the range must only be one the resolution allows.
  fitted.max_range_m =
      std::clamp(fitted.max_range_m, header.resolution_m, kMaxRangeVoxels * header.resolution_m);
  return fitted;
}

void report(std::size_t nodes, const OctomapHeader& header, const FreeSpace& layer) {
  const Grid<std::int8_t> dense = layer.cells.dense();
  const std::vector<std::int8_t>& cells = dense.values();
  const auto free = static_cast<double>(std::count(cells.begin(), cells.end(), kFree));
  const auto unknown = static_cast<double>(std::count(cells.begin(), cells.end(), kUnknown));
  const double cell_m2 = layer.frame.cellArea();
  std::cout << "\n  " << counted(nodes, "node") << ", voxels of " << header.resolution_m << " m\n  "
            << layer.cells.box().width() << " x " << layer.cells.box().height()
            << " cells: " << std::fixed << std::setprecision(2) << free * cell_m2 << " m2 free, "
            << (static_cast<double>(cells.size()) - free - unknown) * cell_m2 << " m2 obstacles\n";
}

void tellNoRays(const std::string& path, bool strict) {
  const std::string what =
      "has no free voxel: it was made without rays, as from a point cloud, so nothing is free";
  const std::string right = "--unknown-is-free makes free what its obstacles enclose";
  if (strict) throw refuse(path, what, right);
  std::cerr << "occusg: " << path << ": " << what << "; " << right << '\n';
}

}  // namespace

ExitCode projectCommand(const std::vector<std::string>& arguments) {
  const po::variables_map values = parse(arguments, projectHelp(), projectOptions());
  if (helpWasPrinted(values)) return kFine;

  const PipelineConfig config = givenConfig(values);
  const std::string path = values["MAP"].as<std::string>();
  const OctomapHeader header = readOctomapHeader(path);
  std::vector<std::string> assumptions;
  const OccupancyMap map =
      readOctomap(path, configFor(header, config), kMaxOctomapNodes, &assumptions);
  const bool strict = values.count("strict") > 0;
  for (const std::string& assumption : assumptions) {
    if (strict) throw refuse(path, assumption, "without --strict this is assumed");
    std::cerr << "occusg: " << path << ": " << assumption << '\n';
  }
  if (!map.cutIslands().none())
    std::cerr << "occusg: " << path << ": " << sentenceOn(map.cutIslands()) << '\n';
  FreeSpaceLayer projection(config.free_space, GridFrame{header.resolution_m});
  const bool has_rays = header.node_count == 0 || hasFreeVoxel(map.tree());
  const UnseenSpace unseen =
      values.count("unknown-is-free") > 0 ? UnseenSpace::kFree : UnseenSpace::kUnknown;
  if (!has_rays && unseen == UnseenSpace::kUnknown) tellNoRays(path, strict);
  if (has_rays && unseen == UnseenSpace::kFree)
    std::cerr << "occusg: " << path << ": has free voxels, so --unknown-is-free changes nothing\n";
  const FreeSpace layer = has_rays ? projection.recompute(map)
                                   : layerWithoutRays(map.tree(), config.free_space, unseen);

  if (layer.cells.box().empty()) {
    throw refuse(path, "holds nothing between the heights that are projected",
                 "a map with voxels is needed");
  }
  checkResultsPlace(values["output"].as<std::string>());
  const OutputFolder folder(values["output"].as<std::string>());
  const MapFiles files = toMapFiles(layer, "free_space.pgm");
  const std::string name = std::filesystem::path(path).stem().string();
  folder.write("free_space.pgm", files.pgm);
  folder.write("free_space.yaml", files.yaml);
  folder.write("overview.png", encodePng(drawOverview(layer, {name, {}, {}, {}})));

  // Where the file declares another number, the tree is what was read.
  report(assumptions.empty() ? header.node_count : map.tree().size(), header, layer);
  std::cout << "\nResults are in " << folder.path() << '\n';
  return kFine;
}

}  // namespace occusg::apps
