// SPDX-License-Identifier: BSD-3-Clause
#include "progress_bar.hpp"

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace occusg::apps {
namespace {

constexpr std::size_t kBarWidth = 30;
constexpr std::chrono::milliseconds kRedrawPeriod{100};

}  // namespace

ProgressBar::ProgressBar(std::string what, std::size_t total)
    : what_(std::move(what)),
      total_(total),
      on_terminal_(isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()),
      drawn_(start_ - kRedrawPeriod) {}

ProgressBar::~ProgressBar() {
  if (on_terminal_) std::fputc('\n', stderr);
}

void ProgressBar::update(std::size_t done) {
  const auto now = std::chrono::steady_clock::now();
  if (!on_terminal_ || total_ == 0 || (done < total_ && now - drawn_ < kRedrawPeriod)) return;
  drawn_ = now;
  const std::chrono::duration<double> elapsed = now - start_;
  const double left_s =
      done == 0 ? 0.0
                : elapsed.count() * static_cast<double>(total_ - done) / static_cast<double>(done);
  const std::size_t filled = kBarWidth * done / total_;
  const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
  std::fprintf(stderr, "\r%s [%s] %zu/%zu  %.0f s left  ", what_.c_str(), bar.c_str(), done, total_,
               left_s);
  std::fflush(stderr);
}

}  // namespace occusg::apps
