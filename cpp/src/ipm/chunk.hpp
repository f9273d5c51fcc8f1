#pragma once

#include <Eigen/Core>

namespace mcplan::ipm {

// Numbers that are computed together, in registers: with loops of fixed length the compiler keeps them there.
inline constexpr int kChunk = 4;
using Chunk = Eigen::Array<double, kChunk, 1>;
using ChunkAt = Eigen::Map<Chunk>;
using ConstChunkAt = Eigen::Map<const Chunk>;

inline int whole_chunks(int count) { return (count + kChunk - 1) / kChunk * kChunk; }

}  // namespace mcplan::ipm
