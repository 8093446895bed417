#include "app/cli/LongBake.h"

#include "app/cli/Report.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>

namespace patina::cli {
namespace {

// How a scheduler tells its array tasks apart. Where it has no variable for the first, it is a
// fixed number; where it has none for the count, that is (last - first) / step + 1.
struct Scheduler {
    const char* name;
    const char* id;
    const char* first; // null: `firstId`
    long firstId;
    const char* count; // null: from last and step
    const char* last;
    const char* step; // null: 1
};
constexpr Scheduler kSchedulers[] = {
    {"a Slurm array", "SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_MIN", 0, "SLURM_ARRAY_TASK_COUNT",
     nullptr, "SLURM_ARRAY_TASK_STEP"},
    {"a Grid Engine array", "SGE_TASK_ID", "SGE_TASK_FIRST", 1, nullptr, "SGE_TASK_LAST",
     "SGE_TASK_STEPSIZE"},
    {"an LSF array", "LSB_JOBINDEX", nullptr, 1, nullptr, "LSB_JOBINDEX_END", "LSB_JOBINDEX_STEP"},
    {"an AWS Batch array", "AWS_BATCH_JOB_ARRAY_INDEX", nullptr, 0, "AWS_BATCH_JOB_ARRAY_SIZE",
     nullptr, nullptr},
    {"parallel GitLab jobs", "CI_NODE_INDEX", nullptr, 1, "CI_NODE_TOTAL", nullptr, nullptr},
    {"Open MPI", "OMPI_COMM_WORLD_RANK", nullptr, 0, "OMPI_COMM_WORLD_SIZE", nullptr, nullptr},
    {"MPI", "PMI_RANK", nullptr, 0, "PMI_SIZE", nullptr, nullptr},
    {"Slurm tasks", "SLURM_PROCID", nullptr, 0, "SLURM_NTASKS", nullptr, nullptr},
};

constexpr long kMaxShards = 1'000'000;

std::optional<long> wholeNumber(std::string_view text) {
    long value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
        return std::nullopt;
    return value;
}

Result<PassShard> shardOf(long index, long count, const std::string& source) {
    if (count < 1 || count > kMaxShards || index < 0 || index >= count)
        return usageError(fmt::format("{} asks for part {} of {}; parts are 1 to {} of at most {}",
                                      source, index + 1, count, std::max(count, 1L), kMaxShards));
    return PassShard{static_cast<int>(index), static_cast<int>(count)};
}

Result<PassShard> automaticShard(const Variables& variables) {
    std::string names;
    for (const Scheduler& scheduler : kSchedulers) {
        names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", scheduler.id, scheduler.name);
        // Grid Engine sets its variable to "undefined" outside arrays.
        const std::optional<std::string> idText = variables(scheduler.id);
        const std::optional<long> id = idText ? wholeNumber(*idText) : std::nullopt;
        if (!id)
            continue;
        const auto number = [&](const char* name) -> std::optional<long> {
            const std::optional<std::string> text =
                name != nullptr ? variables(name) : std::nullopt;
            return text ? wholeNumber(*text) : std::nullopt;
        };
        const long first = number(scheduler.first).value_or(scheduler.firstId);
        if (*id < first) // LSF numbers what is no array 0
            continue;
        const long step = std::max(number(scheduler.step).value_or(1), 1L);
        std::optional<long> count = number(scheduler.count);
        if (const std::optional<long> last = number(scheduler.last); !count && last)
            count = (*last - first) / step + 1;
        if (!count)
            continue;
        return shardOf((*id - first) / step, *count, fmt::format("{}={}", scheduler.id, *id));
    }
    return usageError(
        fmt::format("--shard auto finds no scheduler that numbers its tasks; give K/N, or "
                    "one of these variables with its count: {}",
                    names));
}

} // namespace

std::optional<std::string> environmentVariable(const char* name) {
    const char* value = std::getenv(name); // NOLINT(concurrency-mt-unsafe): nobody changes them
    return value != nullptr ? std::optional<std::string>(value) : std::nullopt;
}

Result<PassShard> parseShard(const std::string& text, const Variables& variables) {
    if (text == "auto")
        return automaticShard(variables);
    const std::size_t slash = text.find('/');
    const std::optional<long> part = wholeNumber(std::string_view(text).substr(0, slash));
    const std::optional<long> count = slash == std::string::npos
                                          ? std::nullopt
                                          : wholeNumber(std::string_view(text).substr(slash + 1));
    if (!part || !count)
        return usageError(
            fmt::format("--shard takes K/N, such as 2/8 for the second of eight parts, or "
                        "auto, not \"{}\"",
                        text));
    return shardOf(*part - 1, *count, "--shard " + text);
}

Result<double> parseInterval(const std::string& text) {
    constexpr std::pair<std::string_view, double> kUnits[] = {
        {"", 1}, {"s", 1}, {"min", 60}, {"m", 60}, {"h", 3600}};
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
    for (const auto& [name, seconds] : kUnits)
        if (error == std::errc() && unit == name && std::isfinite(value) && value > 0)
            return value * seconds;
    return usageError(
        fmt::format("--checkpoint takes a time such as 30s, 5min or 1h, not \"{}\"", text));
}

Result<std::uint64_t> parseSize(const std::string& option, const std::string& text,
                                std::uint64_t least) {
    constexpr std::pair<std::string_view, double> kUnits[] = {
        {"", 1},         {"K", 0x1p10},   {"KiB", 0x1p10}, {"KB", 1e3},     {"M", 0x1p20},
        {"MiB", 0x1p20}, {"MB", 1e6},     {"G", 0x1p30},   {"GiB", 0x1p30}, {"GB", 1e9},
        {"T", 0x1p40},   {"TiB", 0x1p40}, {"TB", 1e12}};
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
    for (const auto& [name, bytes] : kUnits)
        if (error == std::errc() && unit == name && value * bytes >= static_cast<double>(least) &&
            value * bytes < 0x1p63)
            return static_cast<std::uint64_t>(value * bytes);
    return usageError(
        fmt::format("{} takes a size such as 512MiB or 4GiB, not \"{}\"", option, text));
}

} // namespace patina::cli
