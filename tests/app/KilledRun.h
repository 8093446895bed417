// Runs of the built `patina` that end without a chance to react.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace patina::test {

// Runs it and kills it, its own child, `delay` after its first new checkpoint lies there. False
// when it ended before.
bool killAfterACheckpoint(const std::vector<std::string>& arguments,
                          const std::filesystem::path& checkpoint, std::chrono::microseconds delay);

} // namespace patina::test
