// What the options of long bakes mean: which part of the work this process does, and how often it
// keeps a checkpoint.
#pragma once

#include "core/bake/transfer/Passes.h"
#include "core/base/Result.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace patina::cli {

// An environment variable's value, or nothing.
using Variables = std::function<std::optional<std::string>(const char* name)>;
[[nodiscard]] std::optional<std::string> environmentVariable(const char* name);

// "2/8" is the second of eight; "auto" asks the scheduler that started this process (Slurm, Grid
// Engine, LSF, AWS Batch, GitLab, MPI). Usage error otherwise.
Result<PassShard> parseShard(const std::string& text, const Variables& variables);

// Seconds: "30", "30s", "0.5s", "5min", "1h". Usage error otherwise.
Result<double> parseInterval(const std::string& text);

// Bytes: "4GiB", "4G", "512MiB", "4GB" (powers of ten), "1000000"; `least` or more. Otherwise a
// usage error that names `option`.
Result<std::uint64_t> parseSize(const std::string& option, const std::string& text,
                                std::uint64_t least = 1);

} // namespace patina::cli
