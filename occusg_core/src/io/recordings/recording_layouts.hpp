// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "io/recordings/recording.hpp"

namespace occusg {

/// One reader for each layout. `is...` looks at names alone; `read...` throws Error naming what is
/// missing or wrong.

/// The TUM RGB-D benchmark (Sturm et al., IROS 2012), also as downloaded, without a camera file.
[[nodiscard]] bool isTumRecording(const std::string& folder);
[[nodiscard]] Recording readTumRecording(const std::string& folder,
                                         const SequenceReaderConfig& config);

/// 7-Scenes (Shotton et al., CVPR 2013): frame-000000.depth.png, .color.png, .pose.txt.
[[nodiscard]] bool isSevenScenesRecording(const std::string& folder);
[[nodiscard]] Recording readSevenScenesRecording(const std::string& folder,
                                                 const SequenceReaderConfig& config);

/// ScanNet (Dai et al., CVPR 2017) as its SensReader exports it: depth/, color/, pose/, intrinsic/.
[[nodiscard]] bool isScanNetRecording(const std::string& folder);
[[nodiscard]] Recording readScanNetRecording(const std::string& folder,
                                             const SequenceReaderConfig& config);

/// Replica as NICE-SLAM (Zhu et al., CVPR 2022) renders it: results/depth000000.png, traj.txt.
[[nodiscard]] bool isReplicaRecording(const std::string& folder);
[[nodiscard]] Recording readReplicaRecording(const std::string& folder,
                                             const SequenceReaderConfig& config);

/// ICL-NUIM (Handa et al., ICRA 2014), the PNG edition: depth/0.png, rgb/0.png, *.gt.freiburg.
[[nodiscard]] bool isIclNuimRecording(const std::string& folder);
[[nodiscard]] Recording readIclNuimRecording(const std::string& folder,
                                             const SequenceReaderConfig& config);

/// RTAB-Map's rtabmap-export --images --poses_camera: *_depth/, *_rgb/, *_calib/, *_poses.txt.
[[nodiscard]] bool isRtabmapRecording(const std::string& folder);
[[nodiscard]] Recording readRtabmapRecording(const std::string& folder,
                                             const SequenceReaderConfig& config);

}  // namespace occusg
