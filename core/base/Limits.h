// The sizes beyond which Patina refuses an input, in one place. They bound memory and time for
// damaged or hostile files; real work stays far below them.
#pragma once

#include <cstddef>
#include <cstdint>

namespace patina::limits {

inline constexpr int kMaxImageSide = 32768;                                // pixels
inline constexpr std::size_t kMaxImageBytes = std::size_t{2} << 30;        // decoded
inline constexpr int kMaxImageChannels = 1024;                             // bake files have many
inline constexpr int kMaxImageParts = 4096;                                // of an EXR file
inline constexpr std::size_t kMaxTriangles = 50'000'000;                   // per file
inline constexpr std::size_t kMaxMeshes = 100'000;                         // per file
inline constexpr std::size_t kMaxInstances = 100'000;                      // as of a project
inline constexpr std::size_t kMaxModelFileBytes = std::size_t{4} << 30;    // on disk
inline constexpr std::size_t kMaxProjectFileBytes = std::size_t{64} << 20; // JSON text
inline constexpr int kMaxJsonDepth = 64;

inline constexpr std::size_t kWorkerMemoryBytes = std::size_t{8} << 30; // address space
inline constexpr std::size_t kWorkerReplyBytes = std::size_t{4} << 30;  // of one answer
inline constexpr double kWorkerCpuSeconds = 60.0;                       // per file
inline constexpr double kWorkerWallSeconds = 90.0;                      // per file

} // namespace patina::limits
