#include "app/editor/document/EnvironmentResolver.h"

#include "core/light/EnvironmentResample.h"
#include "core/mix/LightMix.h"

#include <algorithm>
#include <utility>

namespace patina::editor {
namespace {
constexpr int kRecipeRestMs = 200;
constexpr std::size_t kKept = 2; // 24 MiB each
} // namespace

EnvironmentResolver::EnvironmentResolver(TaskRunner& runner, QObject* parent)
    : QObject(parent)
    , m_tasks(runner) {
    m_rest.setSingleShot(true);
    m_rest.setInterval(kRecipeRestMs);
    connect(&m_rest, &QTimer::timeout, this, &EnvironmentResolver::refine);
}

void EnvironmentResolver::reset(const Document& document) {
    change(); // what is under way belongs to the document that goes
    m_known.clear();
    for (const Environment& environment : document.environments)
        m_known[environment.id] = {environmentRecipe(environment), false};
    m_first = document.mix.first;
    m_blend = environmentBlend(document);
    m_shown = shownEnvironment(document).image;
    m_blendIsDraft = false;
    m_made.clear();
    m_drafts.clear();
}

bool EnvironmentResolver::update(Document& document) {
    const bool imageChanged = updateImages(document);
    const bool blendChanged = updateBlend(document);
    if (imageChanged || blendChanged) {
        change();
        if (m_blendIsDraft || nextDraft() != 0)
            m_rest.start();
    }
    ImagePtr shown = shownEnvironment(document).image;
    return std::exchange(m_shown, shown) != shown;
}

bool EnvironmentResolver::updateImages(Document& document) {
    m_first = document.mix.first;
    std::erase_if(m_known,
                  [&](const auto& known) { return document.environment(known.first) == nullptr; });
    bool changed = false;
    for (Environment& environment : document.environments)
        changed |= updateImage(environment);
    return changed;
}

// The one that lights the scene first.
Id EnvironmentResolver::nextDraft() const {
    if (const auto first = m_known.find(m_first); first != m_known.end() && first->second.isDraft)
        return m_first;
    const auto draft =
        std::ranges::find_if(m_known, [](const auto& known) { return known.second.isDraft; });
    return draft == m_known.end() ? 0 : draft->first;
}

// What is under way is not wanted any more.
void EnvironmentResolver::change() {
    m_tasks.cancelAll();
    m_rest.stop();
}

bool EnvironmentResolver::updateImage(Environment& environment) {
    EnvironmentRecipe recipe = environmentRecipe(environment);
    const auto found = m_known.find(environment.id);
    if (found == m_known.end() && environment.image &&
        (recipe.kind == EnvironmentKind::Image ||
         environment.image->height() == kEnvironmentHeight)) {
        m_known[environment.id] = {std::move(recipe), false}; // it came with its picture
        return false;
    }
    if (found != m_known.end() && recipe == found->second.recipe)
        return false;
    Known& known = m_known[environment.id] = {std::move(recipe), false};
    ImagePtr image = environment.fileImage;
    if (isGenerated(known.recipe)) {
        const auto made = std::find_if(m_made.begin(), m_made.end(),
                                       [&](const Made& m) { return m.recipe == known.recipe; });
        known.isDraft = made == m_made.end();
        if (known.isDraft) {
            EnvironmentRecipe small = known.recipe;
            if (small.file) // reduced once for all counts
                small.file = draftOf(small.file);
            image = generateEnvironment(small, kDraftEnvironmentHeight);
        } else {
            image = made->image;
        }
    }
    if (image)
        environment.image = std::move(image);
    return true;
}

bool EnvironmentResolver::updateBlend(Document& document) {
    std::optional<EnvironmentBlend> blend = environmentBlend(document);
    if (blend == m_blend)
        return false;
    m_blend = std::move(blend);
    m_blendIsDraft = m_blend.has_value();
    document.mix.blended = nullptr;
    if (m_blend) {
        EnvironmentBlend small = *m_blend;
        small.first = draftOf(small.first);
        small.second = draftOf(small.second);
        document.mix.blended = blendEnvironments(small);
    }
    return true;
}

ImagePtr EnvironmentResolver::draftOf(const ImagePtr& image) {
    if (image->height() <= kDraftEnvironmentHeight)
        return image;
    const auto known = std::find_if(m_drafts.begin(), m_drafts.end(),
                                    [&](const Draft& draft) { return draft.image == image; });
    if (known != m_drafts.end())
        return known->small;
    if (m_drafts.size() == kKept)
        m_drafts.pop_front();
    m_drafts.push_back(
        {image, std::make_shared<const Image>(shrinkLatLong(*image, 2 * kDraftEnvironmentHeight))});
    return m_drafts.back().small;
}

// The picture of both follows when those of the environments are there.
void EnvironmentResolver::refine() {
    const Id environment = nextDraft();
    if (environment == 0 && !m_blendIsDraft)
        return;
    m_tasks.run(
        {.tag = "environment image"},
        [recipe = environment == 0 ? EnvironmentRecipe() : m_known.at(environment).recipe,
         blend = m_blend, ofBoth = environment == 0](const JobContext& job) {
            return ofBoth ? blendEnvironments(*blend, job)
                          : generateEnvironment(recipe, kEnvironmentHeight, job);
        },
        [this, environment](const Result<ImagePtr>& image) {
            if (image && *image) // else the draft stays
                deliver(environment, *image);
        });
}

void EnvironmentResolver::deliver(Id environment, const ImagePtr& image) {
    if (environment == 0) {
        m_blendIsDraft = false;
        m_shown = image;
        Q_EMIT blended(image);
        return;
    }
    const auto known = m_known.find(environment);
    if (known != m_known.end()) { // it was not removed meanwhile
        known->second.isDraft = false;
        m_made.push_back({known->second.recipe, image});
        if (m_made.size() > kKept)
            m_made.pop_front();
        Q_EMIT refined(environment, image);
    }
    if (!m_rest.isActive() && (m_blendIsDraft || nextDraft() != 0))
        m_rest.start();
}

} // namespace patina::editor
