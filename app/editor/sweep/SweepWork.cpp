#include "app/editor/sweep/SweepWork.h"

#include "core/bake/document/BakeStaleness.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/domain/BakeHash.h"
#include "core/document/EnvironmentTitle.h"
#include "core/document/Source.h"
#include "core/document/ViewChoices.h"
#include "core/library/Library.h"
#include "core/light/Light.h"
#include "core/light/OrientedEnvironment.h"
#include "core/material/Material.h"
#include "core/mix/LightMix.h"
#include "core/rank/SweepBake.h"
#include "core/scene/FolderEnvironments.h"
#include "core/scene/Scene.h"

#include <algorithm>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <utility>

namespace patina::editor {
namespace {

// Shares of the time that reading the environments and a quick bake take, for the progress.
constexpr double kRead = 0.2, kBaked = 0.5;

glm::vec3 scaleOf(const Environment& environment) {
    return environment.tint * std::exp2(environment.exposureEv);
}

// Its picture is that of its source, which reading the source gives again.
bool showsSource(const Environment& environment) {
    return environment.kind == EnvironmentKind::Image && environment.problem.empty() &&
           environment.removedSources == 0 && environment.layout == EnvironmentLayout::Automatic;
}

SweptEnvironment sweptOf(const Environment& environment) {
    return {environmentTitle(environment),
            showsSource(environment) ? environment.source : std::string(), environment.id,
            environment.image, scaleOf(environment)};
}

// Collects environments in their order, each once, and measures them.
class SweepReader {
  public:
    SweepReader(const SweepOrder& order, WorkerClient& worker, const JobContext& job)
        : m_order(order)
        , m_worker(worker)
        , m_job(job) {}

    Result<void> read(SweepOutcome& outcome) {
        collect(outcome);
        if (m_wanted.empty() && outcome.problems.empty())
            return Error{ErrorKind::Usage,
                         "There is nothing to sweep; choose the scene's environments, the shipped "
                         "skies or a folder.",
                         {},
                         {}};
        for (std::size_t i = 0; i < m_wanted.size(); ++i) {
            m_job.setActivity(
                fmt::format("reading environments ({} of {})", i + 1, m_wanted.size()));
            const auto share = [&](std::size_t done) {
                return static_cast<double>(done) / static_cast<double>(m_wanted.size());
            };
            if (Result<void> measured =
                    measure(std::move(m_wanted[i]), outcome, m_job.part(share(i), share(i + 1)));
                !measured)
                return measured;
            m_job.setProgress(share(i + 1));
        }
        if (outcome.measured.empty())
            return Error{ErrorKind::InputBroken,
                         fmt::format("None of the environments can be read. {}: {}",
                                     outcome.problems.front().source,
                                     outcome.problems.front().text),
                         {},
                         {}};
        return {};
    }

  private:
    void collect(SweepOutcome& outcome) {
        if (m_order.ofDocument)
            for (const Environment& environment : m_order.document.environments) {
                if (environment.image && environment.problem.empty())
                    m_wanted.push_back(sweptOf(environment));
                else
                    outcome.problems.push_back(
                        {environmentTitle(environment),
                         environment.image ? environment.problem : "its picture is not made yet"});
            }
        if (m_order.shipped)
            for (const library::Entry& entry : library::environments())
                add("builtin:" + entry.name);
        if (m_order.folder.empty())
            return;
        const auto files = environmentFilesOf(m_order.folder);
        if (!files) {
            outcome.problems.push_back({m_order.folder.string(), files.error().message});
            return;
        }
        if (files->files.empty())
            outcome.problems.push_back(
                {m_order.folder.string(), "there is no .hdr, .exr or .pfm in this folder"});
        for (const std::filesystem::path& file : files->files)
            add(file.string());
    }

    // That of the document where it shows the same.
    void add(const std::string& source) {
        const std::string name = normalizeSource(source);
        if (std::ranges::any_of(m_wanted,
                                [&](const SweptEnvironment& e) { return e.source == name; }))
            return;
        const std::vector<Environment>& known = m_order.document.environments;
        const auto same = std::ranges::find_if(known, [&](const Environment& environment) {
            return showsSource(environment) && environment.source == name && environment.image;
        });
        if (same != known.end()) {
            m_wanted.push_back(sweptOf(*same));
            return;
        }
        Environment named;
        named.source = name;
        // It would take the place of what lights the scene, whose tint and exposure stay.
        m_wanted.push_back(
            {environmentTitle(named), name, 0, nullptr, scaleOf(m_order.document.environment())});
    }

    Result<void> measure(SweptEnvironment environment, SweepOutcome& outcome,
                         const JobContext& job) {
        ImagePtr image = environment.image;
        if (!image) {
            std::vector<Notice> notices;
            Result<ImagePtr> read = loadEnvironmentImage(m_worker, environment.source, notices,
                                                         EnvironmentLayout::Automatic, job);
            if (!read) {
                const Error& error = read.error();
                if (error.kind == ErrorKind::Cancelled || error.kind == ErrorKind::Internal)
                    return error;
                outcome.problems.push_back({environment.source, error.message});
                return {};
            }
            image = std::move(*read);
        }
        outcome.measured.push_back(measureEnvironment(environment.title, *image, job));
        outcome.environments.push_back(std::move(environment));
        if (m_job.cancelled())
            return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
        return {};
    }

    const SweepOrder& m_order;
    WorkerClient& m_worker;
    const JobContext& m_job;
    std::vector<SweptEnvironment> m_wanted;
};

// The scene's light as one of the swept ones: a cross-fade is swept, too, as a picture of its own.
Result<void> addReference(const SweepOrder& order, SweepOutcome& outcome, const JobContext& job) {
    const EnvironmentPart shown = shownEnvironment(order.document);
    if (!shown.image)
        return Error{ErrorKind::InputMissing,
                     "The scene's environment has no picture yet; start again when it is shown.",
                     {},
                     {}};
    const bool level = shown.orientation.isLevel(); // as all that is swept
    const auto known = std::ranges::find_if(outcome.environments, [&](const SweptEnvironment& e) {
        return level && e.image == shown.image && e.scale == shown.scale;
    });
    outcome.settings.reference = {static_cast<std::size_t>(known - outcome.environments.begin()),
                                  level ? shown.orientation.rotationDeg : 0.0f};
    if (known != outcome.environments.end())
        return {};
    // As itself, where it is one of the document's that was not to be swept.
    const Environment& first = order.document.environment();
    SweptEnvironment light{"Scene's light", {}, 0, nullptr, shown.scale};
    if (level && shown.image == first.image && shown.scale == scaleOf(first))
        light = sweptOf(first);
    outcome.measured.push_back(measureEnvironment(
        light.title,
        level ? *shown.image : orientEnvironment(*shown.image, shown.orientation, 0.0f, job), job));
    outcome.environments.push_back(std::move(light));
    if (job.cancelled())
        return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
    return {};
}

Result<BakeArtifactPtr> transferFor(const Document& document, SweepTransfer& transfer,
                                    const JobContext& job) {
    Result<SweepBake> chosen = chooseSweepBake(document, job);
    if (!chosen)
        return chosen.error();
    const BakeArtifact& bake = *chosen->bake;
    transfer = {chosen->quick, bake.order, restsOnRays(bake) ? bake.samplesDone : 0, {}};
    // Other colours than the scene's concern bounces alone, which the editor keeps up to date.
    if (!chosen->quick)
        transfer.stale =
            bakeStaleness(bake, document, hashBakeInputs(bakeInputs(document)), bake.albedo)
                .reasons;
    return chosen->bake;
}

// Of the view what the pictures of a sweep depend on.
View sweptView(View view) {
    const View usual;
    view.background = usual.background;
    view.backgroundBlur = usual.backgroundBlur;
    view.backgroundColor = usual.backgroundColor;
    view.lighting = usual.lighting;
    view.ocioConfig = view.ocioDisplay = view.ocioView = {};
    return view;
}

} // namespace

Result<SweepOutcomePtr> runSweep(std::shared_ptr<const SweepOrder> order, WorkerClient& worker,
                                 const JobContext& job) {
    const Document& document = order->document;
    // Before anything is read for it.
    if (document.view.toneMap == ToneMap::OpenColorIo)
        return Error{ErrorKind::Usage,
                     "Lights are ranked with Patina's own tone curves; choose one in place of "
                     "OpenColorIO in the Camera dock.",
                     {},
                     {}};
    auto outcome = std::make_shared<SweepOutcome>();
    outcome->order = order;
    outcome->settings.rotations = order->rotations;
    outcome->settings.view = document.view;
    const bool bakes = !attachedSweepBake(document);
    const double read = bakes ? kRead : kRead / (1.0 - kBaked),
                 baked = bakes ? read + kBaked : read;
    const JobContext reading = job.part(0.0, read);
    if (Result<void> done = SweepReader(*order, worker, reading).read(*outcome); !done)
        return done.error();
    if (order->comparesWithScene)
        if (Result<void> added = addReference(*order, *outcome, reading); !added)
            return added.error();
    // Scaled after: the same picture under another tint is still the same environment.
    outcome->same = findSameEnvironments(outcome->measured, job);
    for (std::size_t i = 0; i < outcome->measured.size(); ++i)
        for (glm::vec3& coefficient : outcome->measured[i].harmonics)
            coefficient *= outcome->environments[i].scale;

    const Result<BakeArtifactPtr> bake =
        transferFor(document, outcome->transfer, job.part(read, baked));
    if (!bake)
        return bake.error();
    Result<SweepPixels> pixels =
        traceSweepPixels(document, bake->get(), document.view.camera, order->width, order->height,
                         job.part(baked, baked));
    if (!pixels)
        return pixels.error();
    outcome->pixels = std::move(*pixels);
    Result<LightSweep> sweep =
        sweepLights(outcome->pixels, outcome->measured, outcome->settings, job.part(baked, 1.0));
    if (!sweep)
        return sweep.error();
    outcome->sweep = std::move(*sweep);
    return SweepOutcomePtr(std::move(outcome));
}

SweptUse useOf(const SweptEnvironment& environment, const Document& document) {
    const Environment* own = environment.id != 0 ? document.environment(environment.id) : nullptr;
    if (own && own->image == environment.image && scaleOf(*own) == environment.scale)
        return SweptUse::OfDocument;
    return environment.source.empty() ? SweptUse::Gone : SweptUse::BySource;
}

bool stillHolds(const SweepOutcome& outcome, const Document& document) {
    const Document& then = outcome.order->document;
    if (then.meshes != document.meshes || then.materials != document.materials ||
        then.lights != document.lights || anySolo(then) != anySolo(document) ||
        sweptView(then.view) != sweptView(document.view) ||
        attachedSweepBake(then) != attachedSweepBake(document))
        return false;
    const glm::vec3 scale = scaleOf(document.environment());
    return std::ranges::all_of(outcome.environments, [&](const SweptEnvironment& environment) {
        switch (useOf(environment, document)) {
        case SweptUse::OfDocument:
            return true;
        case SweptUse::BySource:
            return environment.scale == scale;
        case SweptUse::Gone:
            break;
        }
        // A cross-fade that was compared with is none of the document's environments.
        return environment.id == 0;
    });
}

} // namespace patina::editor
