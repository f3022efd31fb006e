// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "command_line.hpp"
#include "interrupt.hpp"
#include "io/occusg_1_0_file.hpp"
#include "io/room_labels_file.hpp"
#include "io/text_lines.hpp"
#include "mask_source.hpp"
#include "occusg/error.hpp"
#include "occusg/graph/graph_query.hpp"
#include "occusg/io/octomap_file.hpp"
#include "occusg/io/output_folder.hpp"
#include "occusg/io/results.hpp"
#include "occusg/io/sequence_reader.hpp"
#include "occusg/io/session_repair.hpp"
#include "occusg/perception/class_names.hpp"
#include "occusg/pipeline/config_file.hpp"
#include "occusg/regions/no_rooms.hpp"
#include "output_place.hpp"
#include "progress_bar.hpp"
#include "recording_options.hpp"
#include "room_table.hpp"
#include "wall_clock.hpp"

namespace occusg::apps {
namespace {

namespace po = boost::program_options;

constexpr std::size_t kShownBadFrames = 5;

enum class BadFrames { kSkip, kFail };

enum class Schemas { kOurs, kOursAndPublished };

struct RunOutcome {
  std::size_t frames_read = 0;
  std::size_t frames_known = 0;         ///< Not younger than the session that goes on.
  std::vector<std::string> bad_frames;  ///< One sentence each.
  std::vector<std::string> bad_masks;   ///< Of frames whose objects could not be found.
  bool interrupted = false;
};

CommandHelp runHelp() {
  return {
      "occusg run SEQUENCE -o OUT [options]",
      "Takes a recorded RGB-D sequence through the whole pipeline and writes what it found.\n\n"
      "SEQUENCE is a folder in the layout of TUM RGB-D (below), 7-Scenes, ScanNet's export, "
      "Replica\n"
      "of NICE-SLAM, ICL-NUIM or RTAB-Map's export. TUM RGB-D: depth.txt, groundtruth.txt "
      "(timestamp tx ty\n"
      "tz qx qy qz qw, camera optical frame in the world), 16-bit depth PNGs, and camera.json "
      "with\n"
      "width, height, fx, fy, cx, cy, depth_scale. Objects come from labels/ (16-bit object ids,\n"
      "named by \"objects\" of rooms.json), or from a segmentation model run on the colour images\n"
      "of rgb.txt (--model, --classes).\n\n"
      "OUT receives rooms.json, scene_graph.json, .dsg.json and .graphml, rooms.geojson,\n"
      "free_space.pgm and .yaml, map.ot, overview.png and timing.json. A frame that cannot be "
      "used\n"
      "is skipped and reported; more than half of them fail the run. Ctrl-C ends the run early\n"
      "and still writes everything.\n\n"
      "  occusg run examples/apartment -o out/apartment\n"
      "  occusg run recording -o out/recording --config paper\n"
      "  occusg run recording -o out/start --frames 0:500 --param perception.depth.stride=2\n"
      "  occusg run monday -o out/monday --save-session building\n"
      "  occusg run tuesday -o out/tuesday --resume building --save-session building\n"
      "  occusg run second_visit -o out/second --map out/first/map.ot\n",
      {"SEQUENCE"}};
}

po::options_description runOptions() {
  po::options_description options("Options");
  addOutputOption(options);
  addConfigOption(options);
  addDecomposerOption(options);
  options.add_options()("model", po::value<std::string>(),
                        "ONNX segmentation model of the YOLO family")(
      "classes", po::value<std::string>(), "the model's class names, one a line")(
      "room-labels", po::value<std::string>(),
      "table of what speaks for a kind of room (see config/room_labels.yaml)")(
      "map", po::value<std::string>(),
      "OctoMap (.bt, .ot) to start from; same resolution and frame")(
      "resume", po::value<std::string>(),
      "folder of a saved session to continue from, with its room ids; one without a map needs "
      "--map too")("save-session", po::value<std::string>(),
                   "folder to save what the system knows to; a session there is replaced")(
      "schema", po::value<std::string>(),
      "occusg-1.0: also write scene_graph.occusg-1.0.json, the published system's schema")(
      "frames", po::value<std::string>(),
      "A:B: only the frames from A up to, not including, B, counted from 0; either may be left "
      "out")("strict",
             "fail on the first frame that cannot be used, and on anything that would be assumed");
  addRecordingOptions(options);
  return options;
}

PipelineConfig configFrom(const po::variables_map& values) {
  PipelineConfig config =
      overridden(givenConfig(values), values, "decomposer", "regions.decomposer");
  if (const auto table = given<std::string>(values, "room-labels"))
    config.graph.room_labels = readRoomLabels(*table);
  return config;
}

/// @param model how a model is used, if the options name one.
MaskSource masksFor(const SequenceReader& sequence, OnnxSegmenterConfig model,
                    const po::variables_map& values) {
  const bool has_model = values.count("model") > 0;
  if (has_model != (values.count("classes") > 0)) {
    throw refuse(has_model ? "--model" : "--classes", "stands alone",
                 "a model and its class names go together");
  }
  if (!has_model) return MaskSource(sequence);
  model.model_path = values["model"].as<std::string>();
  model.class_names = readClassNames(values["classes"].as<std::string>());
  return MaskSource(model);
}

/// A frame whose objects cannot be found still maps.
InstanceMasks masksOf(const Frame& frame, MaskSource& source, BadFrames bad_frames,
                      RunOutcome& outcome) {
  try {
    return source.masksOf(frame);
  } catch (const Error& error) {
    if (bad_frames == BadFrames::kFail) throw;
    outcome.bad_masks.emplace_back(error.what());
  }
  InstanceMasks none;
  none.image_size = frame.depth.pixels.size();
  return none;
}

Schemas schemasIn(const po::variables_map& values) {
  const auto name = given<std::string>(values, "schema");
  if (!name) return Schemas::kOurs;
  if (*name == "occusg-1.0") return Schemas::kOursAndPublished;
  throw UsageError("--schema is '" + *name + "'; allowed is occusg-1.0");
}

/// Which frames of a recording are read: from `first` up to, not including, `end`.
struct FrameRange {
  std::size_t first = 0;
  std::size_t end = 0;

  [[nodiscard]] std::size_t size() const { return end - first; }
};

/// A whole number; `fallback` for an empty text; empty when the text is neither.
std::optional<std::size_t> frameNumberIn(const std::string& text, std::size_t fallback) {
  if (text.empty()) return fallback;
  constexpr std::size_t kMostDigits = 18;
  const bool is_number =
      text.size() <= kMostDigits && text.find_first_not_of("0123456789") == std::string::npos;
  if (!is_number) return std::nullopt;
  return static_cast<std::size_t>(std::stoull(text));
}

/// @throws UsageError for a --frames that is not A:B; Error when it names no frame of the `count`.
FrameRange framesIn(const po::variables_map& values, std::size_t count, const std::string& scene) {
  const auto text = given<std::string>(values, "frames");
  if (!text) return {0, count};
  const std::size_t colon = text->find(':');
  if (colon == std::string::npos) throw UsageError("--frames is '" + *text + "'; A:B is needed");
  const auto first = frameNumberIn(text->substr(0, colon), 0);
  const auto end = frameNumberIn(text->substr(colon + 1), count);
  if (!first || !end)
    throw UsageError("--frames is '" + *text + "'; A:B with whole numbers is needed");
  if (*first >= *end || *first >= count) {
    throw refuse(scene, "has no frame in --frames " + *text,
                 "frames 0 to " + std::to_string(count - 1) + " are there");
  }
  return {*first, std::min(*end, count)};
}

/// @param known_until_s stamp of the last frame of the session that goes on, if one does.
RunOutcome processAll(const SequenceReader& sequence, const Pose& T_level_map, MaskSource& source,
                      Pipeline& pipeline, const FrameRange& frames, BadFrames bad_frames,
                      const std::optional<double>& known_until_s) {
  RunOutcome outcome;
  ProgressBar progress(sequence.scene(), frames.size());
  for (std::size_t i = frames.first; i < frames.end; ++i) {
    outcome.interrupted = interrupted();
    if (outcome.interrupted) break;
    ++outcome.frames_read;
    try {
      Frame frame = sequence.read(i);
      frame.T_map_camera = T_level_map * frame.T_map_camera;
      if (known_until_s && frame.stamp_s <= *known_until_s) {
        ++outcome.frames_known;
      } else {
        pipeline.process(frame, masksOf(frame, source, bad_frames, outcome));
      }
    } catch (const Error& error) {
      if (bad_frames == BadFrames::kFail) throw;
      outcome.bad_frames.emplace_back(error.what());
    }
    progress.update(i - frames.first + 1);
  }
  return outcome;
}

void sayWhatWasCut(const OccupancyMap& map, const std::string& where) {
  if (!map.cutIslands().none())
    std::cerr << "occusg: " << where << ": " << sentenceOn(map.cutIslands()) << '\n';
}

OccupancyMap mapIn(const std::string& path, const OccupancyMapConfig& config) {
  OccupancyMap map = readOctomap(path, config);
  sayWhatWasCut(map, path);
  return map;
}

/// Makes the pipeline go on from what the options name; the last stamp it knows.
std::optional<double> goOn(Pipeline& pipeline, const po::variables_map& values) {
  const auto map = given<std::string>(values, "map");
  const auto session_folder = given<std::string>(values, "resume");
  const OccupancyMapConfig& config = pipeline.config().occupancy;
  if (!session_folder) {
    if (map) pipeline.startFrom(mapIn(*map, config));
    return std::nullopt;
  }
  Session session = loadSession(*session_folder, config);
  if (map && session.map) throw UsageError("--map and --resume: the session has its own map");
  if (map) session.map = readOctomap(*map, config);
  if (!session.map) {
    throw refuse(*session_folder, "was saved without a 3D map",
                 "name the one that was saved beside it, as in --map map.ot");
  }
  sayWhatWasCut(*session.map, *session_folder);
  if (const std::size_t stamps = repairStamps(session.state, latestCredibleStamp()); stamps > 0) {
    std::cerr << "occusg: " << *session_folder << ": " << counted(stamps, "stamp")
              << (stamps == 1 ? " is" : " are")
              << " from the future; taken as of the latest stamp before\n";
  }
  const double stamp_s = session.state.stamp_s;
  pipeline.resume(std::move(session));
  return stamp_s;
}

void failWhenNoFrameIsNew(const RunOutcome& outcome, const std::string& scene) {
  if (outcome.frames_known == 0 || outcome.frames_known < outcome.frames_read) return;
  throw refuse(scene, "has no frame that is younger than the session",
               "a recording that continues it is needed");
}

void failWhenMostFramesAreBad(const RunOutcome& outcome, const std::string& scene) {
  if (2 * outcome.bad_frames.size() <= outcome.frames_read) return;
  throw refuse(scene,
               std::to_string(outcome.bad_frames.size()) + " of " +
                   std::to_string(outcome.frames_read) +
                   " frames cannot be used, the first because " + outcome.bad_frames.front(),
               "at least half must be usable");
}

void failWhenMostPosesAreBad(const MapCounts& counts, const std::string& scene) {
  if (2 * counts.framesMisplaced() <= counts.frames) return;
  throw refuse(scene,
               std::to_string(counts.framesMisplaced()) + " of " + std::to_string(counts.frames) +
                   " frames have poses outside the map or that jumped",
               "poses in metres near the origin of the map frame are needed");
}

void failWhenMostFramesHaveNoDepth(const MapCounts& counts, const std::string& scene) {
  if (2 * counts.frames_without_depth <= counts.frames) return;
  throw refuse(scene,
               std::to_string(counts.frames_without_depth) + " of " +
                   std::to_string(counts.frames) +
                   " frames have no pixel with a depth that can be used",
               "is --depth-scale, the pixel value of one metre, right?");
}

/// A hint when most depths are those of a table top; empty when they are those of rooms.
std::string doubtOnDepths(const SequenceReader& sequence, const FrameRange& frames) {
  constexpr std::size_t kSampledFrames = 20;
  constexpr double kTooNear_m = 0.5;
  std::size_t near = 0;
  std::size_t all = 0;
  const std::size_t step = std::max<std::size_t>(1, frames.size() / kSampledFrames);
  for (std::size_t i = frames.first; i < frames.end; i += step) {
    try {
      const DepthImage depth = sequence.read(i).depth;
      const int valid = cv::countNonZero(depth.pixels);
      const cv::Mat far = depth.pixels >= kTooNear_m * depth.units_per_m;
      all += static_cast<std::size_t>(valid);
      near += static_cast<std::size_t>(valid - cv::countNonZero(far));
    } catch (const Error&) {  // told already
      continue;
    }
  }
  if (2 * near <= all) return "";
  return "most depths are below 0.5 m: is the unit of the depth images right (--depth-scale)?";
}

/// Says why there is no room, and what is odd about those there are.
void tellDoubtsOnRooms(const Pipeline& pipeline, const SequenceReader& sequence,
                       const FrameRange& frames) {
  if (pipeline.graph().nodes(NodeType::kRoom).empty()) {
    std::cerr << "occusg: no rooms: "
              << whyNoRooms(pipeline.freeSpace(), smallestRegion_m2(pipeline.config())) << '\n';
    const std::string on_depths = doubtOnDepths(sequence, frames);
    if (!on_depths.empty()) std::cerr << "occusg: " << on_depths << '\n';
  }
  const std::string doubt = doubtOnLargestRoom(pipeline.graph());
  if (!doubt.empty()) std::cerr << "occusg: " << doubt << " (--depth-scale)\n";
}

void printCounts(const PipelineCounts& counts) {
  const PixelDrops& drops = counts.pixel_drops;
  std::cout << "\n  " << counted(counts.frames, "frame") << ", " << counts.points
            << " points; pixels dropped: " << drops.zero << " without return, " << drops.too_near
            << " too near, " << drops.too_far << " too far, "
            << drops.nan + drops.infinite + drops.negative + drops.implausible << " not a depth\n  "
            << counts.region_updates << " region updates, " << counts.rejected_region_updates
            << " rejected; " << counts.room_id_switches << " room id switches\n";
  if (counts.objects.detections + counts.refused_masks.total() > 0) {
    std::cout << "  " << counts.objects.detections << " detections, "
              << counts.refused_masks.total() + counts.objects.refused + counts.objects.over_limit
              << " refused; " << counts.objects.merged << " objects merged, "
              << counts.objects.ghosts << " removed as ghosts\n";
  }
  const auto say = [](std::size_t count, const char* one, const char* what) {
    if (count > 0) std::cout << "  " << counted(count, one) << what << '\n';
  };
  say(counts.points_outside_map, "point",
      " ignored: beyond the 32 768 voxels an OctoMap reaches from its origin");
  say(counts.frames_outside_map, "frame", " from outside the map, ignored");
  say(counts.frames_too_fast, "frame",
      " ignored: the pose jumped farther than perception.poses.max_speed_m_s allows");
  say(counts.frames_beyond_span, "frame",
      " ignored: the map would span more than a free-space layer can");
  say(counts.frames_without_depth, "frame", " without any depth");
  say(counts.frames_from_occupied, "frame", " from inside an occupied voxel, not mapped");
  say(counts.frames_without_memory, "frame",
      " not mapped: the map has reached mapping.occupancy.max_memory_mb");
}

void reportSkipped(const std::vector<std::string>& sentences, const std::string& what) {
  if (sentences.empty()) return;
  std::cerr << "occusg: skipped " << what << '\n';
  for (std::size_t i = 0; i < std::min(kShownBadFrames, sentences.size()); ++i)
    std::cerr << "  " << sentences[i] << '\n';
  if (sentences.size() > kShownBadFrames)
    std::cerr << "  ... and " << sentences.size() - kShownBadFrames << " more\n";
}

void reportBadInput(const SequenceReader& sequence, const RunOutcome& outcome) {
  for (const std::string& line : sequence.unusableLines())
    std::cerr << "occusg: skipped: " << line << '\n';
  const std::string of_all = " of " + std::to_string(outcome.frames_read) + " frames";
  reportSkipped(outcome.bad_frames, std::to_string(outcome.bad_frames.size()) + of_all);
  reportSkipped(outcome.bad_masks,
                "the objects in " + std::to_string(outcome.bad_masks.size()) + of_all);
}

/// Says what is assumed or looks wrong; @throws Error instead when `strict`.
void tellDoubts(const Placement& placement, const std::string& folder, bool strict) {
  for (const std::string& doubt : placement.doubts) {
    if (strict) throw refuse(folder, doubt, "without --strict it is taken so");
    std::cerr << "occusg: " << folder << ": " << doubt << '\n';
  }
  if (placement.levelled) std::cerr << "occusg: " << folder << ": " << *placement.levelled << '\n';
}

/// Does what may fail without taking with it what follows.
template <typename Step>
void trying(std::vector<std::string>& problems, const Step& step) {
  try {
    step();
  } catch (const Error& error) {
    problems.emplace_back(error.what());
  }
}

std::vector<ResultWriter> filesOf(const Pipeline& pipeline, const std::string& scene,
                                  const StageTimes& times, Schemas schemas) {
  std::vector<ResultWriter> files = resultWriters(pipeline, scene, times);
  if (schemas == Schemas::kOursAndPublished) {
    const auto published = [&pipeline, scene](std::ostream& out) {
      out << toOccusg10(pipeline.graph(), scene);
    };
    files.insert(files.begin(), {"scene_graph.occusg-1.0.json", published});
  }
  return files;
}

/// The results have names that files of a recording have too, such as its annotated rooms.json.
void checkOutputPlace(const std::string& output, const std::string& recording) {
  std::error_code failed;
  if (std::filesystem::equivalent(output, recording, failed) && !failed) {
    throw refuse(output, "is the folder of the recording, whose rooms.json may be its annotation",
                 "another folder is needed for the results");
  }
  checkResultsPlace(output);
}

}  // namespace

ExitCode runCommand(const std::vector<std::string>& arguments) {
  const po::variables_map values = parse(arguments, runHelp(), runOptions());
  if (helpWasPrinted(values)) return kFine;

  const PipelineConfig config = configFrom(values);
  const std::string recording = values["SEQUENCE"].as<std::string>();
  const SequenceReaderConfig reading = readingFrom(values);
  const bool level = values.count("level") > 0;
  if (level && values.count("map") + values.count("resume") > 0)
    throw UsageError("--level would turn the recording away from the map of --map or --resume");
  const SequenceReader sequence(recording, reading);
  const FrameRange frames = framesIn(values, sequence.size(), sequence.scene());
  const Schemas schemas = schemasIn(values);
  const Placement placement = placementOf(sequence, recording, reading, level);
  tellDoubts(placement, recording, values.count("strict") > 0);
  Pipeline pipeline(config);
  const std::optional<double> known_until_s = goOn(pipeline, values);
  const auto session_folder = given<std::string>(values, "save-session");
  const auto output = values["output"].as<std::string>();
  checkOutputPlace(output, recording);
  if (session_folder) checkSessionCanBeSaved(*session_folder, output);
  MaskSource source = masksFor(sequence, config.segmenter, values);
  const OutputFolder folder(output);
  catchInterrupts();
  const RunOutcome outcome =
      processAll(sequence, placement.T_level_map, source, pipeline, frames,
                 values.count("strict") > 0 ? BadFrames::kFail : BadFrames::kSkip, known_until_s);
  failWhenMostFramesAreBad(outcome, sequence.scene());
  failWhenNoFrameIsNew(outcome, sequence.scene());
  failWhenMostPosesAreBad(pipeline.counts(), sequence.scene());
  failWhenMostFramesHaveNoDepth(pipeline.counts(), sequence.scene());
  // Before `finish`, and written after the results: a session that cannot be saved costs none.
  std::optional<SessionState> session;
  std::vector<std::string> problems;
  trying(problems, [&] {
    if (session_folder) session = pipeline.sessionState(sequence.scene());
  });
  pipeline.finish();

  StageTimes times = pipeline.times();
  setPeakMemory(times);
  trying(problems,
         [&] { writeResultFiles(folder, filesOf(pipeline, sequence.scene(), times, schemas)); });
  trying(problems, [&] {
    if (session) saveSession(*session_folder, pipeline.occupancyMap().tree(), *session);
  });

  printRooms(roomsOf(pipeline, sequence.scene()));
  tellDoubtsOnRooms(pipeline, sequence, frames);
  printTimes(times);
  printCounts(pipeline.counts());
  if (outcome.frames_known > 0) {
    std::cout << "  " << counted(outcome.frames_known, "frame")
              << " the session knows already, left out\n";
  }
  reportBadInput(sequence, outcome);
  for (const std::string& problem : problems) std::cerr << "occusg: " << problem << '\n';
  if (problems.empty()) std::cout << "\nResults are in " << folder.path() << '\n';
  if (!outcome.interrupted) return problems.empty() ? kFine : kFailed;
  std::cerr << "occusg: interrupted after " << outcome.frames_read << " of " << frames.size()
            << " frames; the results hold what was found until then\n";
  return kFailed;
}

}  // namespace occusg::apps
