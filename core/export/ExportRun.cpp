#include "core/base/AtomicFile.h"
#include "core/base/DiskSpace.h"
#include "core/base/OwnFile.h"
#include "core/export/Export.h"
#include "core/job/Parallel.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <optional>
#include <system_error>

namespace patina {
namespace {

namespace fs = std::filesystem;

struct FileToWrite {
    fs::path path;
    Bytes data;
};

Error cancelled() {
    return {ErrorKind::Cancelled, "the export was cancelled; nothing was written", {}, {}};
}

// The files' bytes, by stages; `order`: of the files, stage after stage.
Result<std::vector<Bytes>> makeAll(WorkerClient& worker, const ExportPlan& plan,
                                   const std::vector<std::size_t>& order, const JobContext& job) {
    std::vector<std::optional<Result<Bytes>>> made(order.size());
    std::atomic<std::size_t> done = 0;
    const auto make = [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            made[i] = plan.files[order[i]].make(worker, job);
            job.setProgress(0.9 * static_cast<double>(++done) / static_cast<double>(order.size()));
        }
    };
    for (std::size_t first = 0; first < order.size();) {
        std::size_t last = first + 1;
        while (last < order.size() &&
               plan.files[order[last]].stage == plan.files[order[first]].stage)
            ++last;
        parallelFor(job, last - first, 1,
                    [&](std::size_t begin, std::size_t end) { make(first + begin, first + end); });
        if (job.cancelled())
            return cancelled();
        for (; first < last; ++first)
            if (!made[first]->ok())
                return made[first]->error();
    }
    std::vector<Bytes> files;
    for (std::optional<Result<Bytes>>& file : made)
        files.push_back(std::move(**file));
    return files;
}

// Writes all files, the one that refers to the others last. When one fails, those that were not
// there before disappear again.
// `named`: the one whose name the user chose; a link there is followed.
Result<std::vector<fs::path>> writeAll(std::vector<FileToWrite> files, const fs::path& named,
                                       const JobContext& job) {
    std::vector<fs::path> written, created;
    const auto undo = [&](Error error) {
        std::error_code ignored;
        for (const fs::path& path : created)
            fs::remove(path, ignored);
        return error;
    };
    for (const FileToWrite& file : files) {
        if (job.cancelled())
            return undo(cancelled());
        std::error_code ignored;
        const bool existed = fs::exists(file.path, ignored);
        if (Result<void> result = file.path == named ? writeFileAtomically(file.path, file.data)
                                                     : writeOwnFile(file.path, file.data);
            !result)
            return undo(result.error());
        written.push_back(file.path);
        if (!existed)
            created.push_back(file.path);
    }
    return written;
}

} // namespace

Result<std::vector<fs::path>> runExport(WorkerClient& worker, const ExportPlan& plan,
                                        const JobContext& job) {
    if (plan.problem)
        return *plan.problem;
    std::vector<std::size_t> order(plan.files.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return plan.files[i].stage; });
    Result<std::vector<Bytes>> made = makeAll(worker, plan, order, job);
    if (!made)
        return made.error();
    std::vector<FileToWrite> files;
    for (std::size_t i = 0; i < order.size(); ++i)
        if (const PlannedFile& file = plan.files[order[i]]; !file.embedded)
            files.push_back({file.path, std::move((*made)[i])});
    const fs::path& output = plan.settings.output;
    std::uint64_t bytes = 0, largest = 0;
    for (const FileToWrite& file : files) {
        bytes += file.data.size();
        largest = std::max<std::uint64_t>(largest, file.data.size());
    }
    if (Result<void> fits = checkDiskSpace(output, bytes, largest); !fits)
        return fits.error();
    Result<std::vector<fs::path>> written = writeAll(std::move(files), output, job);
    if (written)
        job.setProgress(1.0);
    return written;
}

} // namespace patina
