// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace occusg {

/// An input or output of a model.
struct OnnxTensor {
  std::string name;
  std::vector<std::int64_t> shape;  ///< 0: left open by the model.
};

/// What a model takes and gives.
struct OnnxSignature {
  std::vector<OnnxTensor> inputs;  ///< Without those that are weights.
  std::vector<OnnxTensor> outputs;
};

/// Reads the signature of a model (ONNX IR, `onnx.proto3`, messages ModelProto to TensorShapeProto,
/// as protocol buffers). OpenCV loads the layers but does not tell what the model was made for.
/// @return nothing when the bytes are not a model, or cut short.
[[nodiscard]] std::optional<OnnxSignature> readOnnxSignature(const std::string& bytes);

}  // namespace occusg
