// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <opencv2/core/mat.hpp>
#include <string>
#include <utility>
#include <vector>

namespace occusg {

/// The pixels of one object in an image.
struct InstanceMask {
  int class_id = -1;         ///< As the source numbers its classes.
  std::string class_name;    ///< Empty: the source does not know the class.
  double score = 0.0;        ///< Confidence, 0..1.
  cv::Rect box;              ///< Where `pixels` lies in the image [pixels].
  cv::Mat pixels;            ///< CV_8UC1 of the box's size; not zero: the object.
  int source_object_id = 0;  ///< The object's id in a labelled recording; 0: there is none.
};

/// Why an instance gave no detection.
enum class MaskRefusal {
  kBadNumber,     ///< A NaN or infinity, or a score outside 0..1.
  kUnknownClass,  ///< Its class has no name.
  kWrongSize,     ///< Pixels of another type or size than the box, or a box outside the image.
  kEmpty,         ///< No pixel belongs to it.
  kOverLimit,     ///< There were more masks than a frame may have.
  kTooFewPoints,  ///< Too few pixels with depth near each other.
};
inline constexpr std::size_t kMaskRefusalCount = 6;

/// How many instances were refused, by reason, and a sentence on the first of each.
class RefusedMasks {
 public:
  /// Counts `count` instances refused; `sentence` says why, and is made only when it is wanted.
  template <typename Sentence>
  void add(MaskRefusal reason, const Sentence& sentence, std::size_t count = 1) {
    Entry& entry = entries_[static_cast<std::size_t>(reason)];
    if (entry.count == 0 && count > 0) entry.first = sentence();
    entry.count += count;
  }

  [[nodiscard]] std::size_t count(MaskRefusal reason) const {
    return entries_[static_cast<std::size_t>(reason)].count;
  }
  /// What was wrong with the first one refused for this reason; empty when there was none.
  [[nodiscard]] const std::string& first(MaskRefusal reason) const {
    return entries_[static_cast<std::size_t>(reason)].first;
  }
  [[nodiscard]] std::size_t total() const {
    std::size_t sum = 0;
    for (const Entry& entry : entries_) sum += entry.count;
    return sum;
  }

 private:
  struct Entry {
    std::size_t count = 0;
    std::string first;
  };
  std::array<Entry, kMaskRefusalCount> entries_;
};

/// Most instances taken from one image: as many as the segmentation models give.
inline constexpr std::size_t kMaxMasks = 300;

/// The instances found in one image.
struct InstanceMasks {
  cv::Size image_size;  ///< Of the image the boxes refer to [pixels].
  std::vector<InstanceMask> masks;
  RefusedMasks refused;  ///< Instances that did not become masks.
};

/// A recorded label image -> one mask for each object in it, by rising object id, score 1.
///
/// Classes are numbered in alphabetical order of the labels. An object `label_of_object` does not
/// name keeps its mask, without a class name. When there are more than `kMaxMasks` objects, or
/// their boxes hold more than 2^26 pixels together, those of the fewest pixels are refused.
/// @param object_ids CV_16UC1: the id of the object per pixel, 0: none.
/// @param label_of_object what each object of the recording is.
/// @throws Error when the image is empty or of another type.
[[nodiscard]] InstanceMasks masksOf(const cv::Mat& object_ids,
                                    const std::map<int, std::string>& label_of_object);

}  // namespace occusg
