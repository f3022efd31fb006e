// SPDX-License-Identifier: BSD-3-Clause
#include "batch_runner.hpp"

#include <string.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <list>
#include <memory>
#include <optional>
#include <system_error>
#include <vector>

#include "batch_results.hpp"
#include "child_process.hpp"
#include "interrupt.hpp"
#include "io/external_rooms.hpp"
#include "io/file_bytes.hpp"
#include "io/text_lines.hpp"
#include "occusg/error.hpp"
#include "occusg/io/output_folder.hpp"
#include "occusg/io/results.hpp"
#include "report/scene_folder.hpp"

namespace occusg::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxTextBytes = std::size_t{64} << 20U;
constexpr long kPollPeriod_ns = 20'000'000;

/// A scene under one configuration.
struct Task {
  const Configuration* configuration = nullptr;
  const Recording* recording = nullptr;
  std::string folder;
  double weight = 1.0;  ///< Of its duration, for the time left: the length of its list of images.
};

std::string at(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / name).string();
}

std::string readIfThere(const std::string& path) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return "";
  return readFile(path, kMaxTextBytes);
}

std::vector<Task> tasksOf(const BatchOptions& options) {
  std::vector<Task> tasks;
  for (std::size_t i = options.shard.index; i < options.recordings.size();
       i += options.shard.count) {
    const Recording& recording = options.recordings[i];
    std::error_code failed;
    const auto list_bytes = fs::file_size(at(recording.folder, "depth.txt"), failed);
    for (const Configuration& configuration : options.configurations) {
      tasks.push_back(
          {&configuration, &recording,
           sceneFolder(options.out, configuration.name, recording.scene),
           failed || configuration.yaml.empty() ? 1.0 : static_cast<double>(list_bytes) + 1.0});
    }
  }
  return tasks;
}

/// Same recording, same parameters, and done.
bool isFinished(const Task& task) {
  try {
    const std::string text = readIfThere(at(task.folder, "run.json"));
    if (text.empty()) return false;
    const RunRecord record = parseRunRecord(text, "run.json");
    return record.status == RunStatus::kDone && record.recording == task.recording->folder &&
           readIfThere(at(task.folder, "config.yaml")) == task.configuration->yaml &&
           fs::exists(at(task.folder, "rooms.json"));
  } catch (const Error&) {
    return false;
  }
}

/// An empty folder with the parameters and the truth.
OutputFolder preparedFolder(const Task& task) {
  std::error_code ignored;
  fs::remove_all(task.folder, ignored);
  OutputFolder folder(task.folder);
  if (!task.configuration->yaml.empty()) folder.write("config.yaml", task.configuration->yaml);
  const auto copy = [&](const char* from, const char* to) {
    const std::string bytes = readIfThere(at(task.recording->folder, from));
    if (!bytes.empty()) folder.write(to, bytes);
  };
  copy("rooms.json", "truth.json");
  copy("objects.json", "truth_objects.json");
  return folder;
}

RunRecord importExternal(const Task& task, const OutputFolder& folder) {
  RunRecord record{task.recording->folder, RunStatus::kMissing, "", 0.0};
  const std::string& from = task.configuration->external_folder;
  std::error_code ignored;
  for (const std::string& name :
       {task.recording->scene + ".json", task.recording->scene + "/rooms.json"}) {
    if (!fs::exists(at(from, name), ignored)) continue;
    try {
      folder.write("rooms.json", toJson(readExternalRooms(at(from, name), RingOrder::kAsWritten)));
      record.status = RunStatus::kDone;
    } catch (const Error& error) {
      record.status = RunStatus::kFailed;
      record.problem = error.what();
    }
    return record;
  }
  record.problem =
      "no " + task.recording->scene + ".json among the predictions of " + task.configuration->name;
  return record;
}

/// The last sentence the run said of itself, or how it ended.
std::string problemOf(int end, const std::string& log_path) {
  if (end < 0) return "ended by signal " + std::to_string(-end) + " (" + strsignal(-end) + ")";
  std::string log;
  try {
    log = readIfThere(log_path);
  } catch (const Error&) {
    log.clear();
  }
  const std::string head = "occusg: ";
  const std::size_t start = log.rfind("\n" + head);
  const bool at_begin = log.compare(0, head.size(), head) == 0;
  if (start == std::string::npos && !at_begin) return "exit code " + std::to_string(end);
  const std::size_t from = (start == std::string::npos ? 0 : start + 1) + head.size();
  return log.substr(from, log.find('\n', from) - from);
}

std::string shownDuration(double seconds) {
  char text[48];
  if (seconds < 10.0) {
    std::snprintf(text, sizeof text, "%.2g s", seconds);
  } else if (seconds < 90.0) {
    std::snprintf(text, sizeof text, "%.0f s", seconds);
  } else if (seconds < 5400.0) {
    std::snprintf(text, sizeof text, "%.0f min", seconds / 60.0);
  } else {
    std::snprintf(text, sizeof text, "%.1f h", seconds / 3600.0);
  }
  return text;
}

/// A line for every scene that ends.
class Progress {
 public:
  explicit Progress(const std::vector<Task>& tasks) : total_(tasks.size()) {
    for (const Task& task : tasks) weight_left_ += task.weight;
    clock_gettime(CLOCK_MONOTONIC, &start_);
  }

  void ended(const Task& task, const std::string& how, double seconds) {
    ++done_;
    weight_left_ -= task.weight;
    weight_done_ += task.weight;
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    const double elapsed_s = static_cast<double>(now.tv_sec - start_.tv_sec) +
                             static_cast<double>(now.tv_nsec - start_.tv_nsec) * 1e-9;
    const double left_s = elapsed_s * weight_left_ / weight_done_;
    std::printf("[%3zu/%zu] %-28s %-20s %-10s %7.1f s", done_, total_,
                task.configuration->name.c_str(), task.recording->scene.c_str(), how.c_str(),
                seconds);
    if (done_ < total_) std::printf("   about %s left", shownDuration(left_s).c_str());
    std::printf("\n");
    std::fflush(stdout);
  }

 private:
  std::size_t total_;
  std::size_t done_ = 0;
  double weight_left_ = 0.0;
  double weight_done_ = 0.0;
  timespec start_{};
};

/// A run under way.
struct Running {
  Task task;
  OutputFolder folder;
  std::unique_ptr<ChildProcess> process;
};

class BatchRun {
 public:
  BatchRun(const BatchOptions& options, std::vector<Task> tasks)
      : options_(options),
        program_(ownProgram()),
        waiting_(std::move(tasks)),
        progress_(waiting_) {}

  BatchEnd run() {
    std::size_t next = 0;
    while (next < waiting_.size() || !running_.empty()) {
      if (interrupted()) return BatchEnd::kInterrupted;  // what runs is ended with this object
      while (next < waiting_.size() && running_.size() < options_.jobs) start(waiting_[next++]);
      collect();
      const timespec pause{0, kPollPeriod_ns};
      if (!running_.empty()) nanosleep(&pause, nullptr);
    }
    return BatchEnd::kComplete;
  }

 private:
  void start(const Task& task) {
    OutputFolder folder = preparedFolder(task);
    if (!task.configuration->external_folder.empty()) {
      finish(task, folder, importExternal(task, folder));
      return;
    }
    const std::vector<std::string> command{
        program_,    "run",      task.recording->folder,        "-o",
        task.folder, "--config", at(task.folder, "config.yaml")};
    auto process = std::make_unique<ChildProcess>(command, at(task.folder, "log.txt"));
    running_.push_back({task, std::move(folder), std::move(process)});
  }

  void collect() {
    for (auto it = running_.begin(); it != running_.end();) {
      ChildProcess& process = *it->process;
      const double seconds = process.seconds();
      RunRecord record{it->task.recording->folder, RunStatus::kDone, "", seconds};
      const std::optional<int> end = process.ended();
      if (!end && (options_.timeout_s <= 0.0 || seconds <= options_.timeout_s)) {
        ++it;
        continue;
      }
      if (!end) {
        process.kill();
        record.status = RunStatus::kTimedOut;
        record.problem = "took longer than " + shownDuration(options_.timeout_s) + " (--timeout)";
      } else if (*end != 0) {
        record.status = RunStatus::kFailed;
        record.problem = problemOf(*end, at(it->task.folder, "log.txt"));
      }
      finish(it->task, it->folder, record);
      it = running_.erase(it);
    }
  }

  void finish(const Task& task, const OutputFolder& folder, const RunRecord& record) {
    folder.write("run.json", toJson(record));
    progress_.ended(task, nameOf(record.status), record.seconds);
  }

  const BatchOptions& options_;
  std::string program_;
  std::vector<Task> waiting_;
  std::list<Running> running_;
  Progress progress_;
};

}  // namespace

BatchEnd runBatch(const BatchOptions& options) {
  checkResultsPlace(options.out);
  const OutputFolder out(options.out);
  BatchIndex index{{}, {}, nameOf(options.alignment), options.title};
  for (const Configuration& c : options.configurations) index.configurations.push_back(c.name);
  for (const Recording& r : options.recordings) index.scenes.push_back(r.scene);
  out.write("batch.json", toJson(index));
  std::vector<Task> tasks = tasksOf(options);
  const std::size_t all = tasks.size();
  tasks.erase(std::remove_if(tasks.begin(), tasks.end(), isFinished), tasks.end());
  std::printf("%s, %zu of them finished before, %zu at a time\n", counted(all, "run").c_str(),
              all - tasks.size(), options.jobs);
  std::fflush(stdout);
  catchInterrupts();
  return BatchRun(options, std::move(tasks)).run();
}

ExitCode runAndReport(const BatchOptions& options) {
  if (runBatch(options) == BatchEnd::kInterrupted) {
    std::cerr << "occusg: interrupted; the same command continues where it stopped\n";
    return kFailed;
  }
  if (options.shard.count > 1) {
    std::cout << "\nShard " << options.shard.index + 1 << " of " << options.shard.count
              << " is finished; when all are: occusg merge " << options.out << " -o " << options.out
              << '\n';
    return kFine;
  }
  const BatchResults batch = collectResults({options.out});
  writeResults(batch, options.title, options.out);
  return reportFailures(batch);
}

}  // namespace occusg::apps
