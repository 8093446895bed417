#include "app/editor/document/EnvironmentResolver.h"

#include "core/light/EnvironmentResample.h"
#include "core/mix/LightMix.h"

#include <algorithm>
#include <utility>

namespace patina::editor {
namespace {
constexpr int kRestMs = 200;
constexpr std::size_t kKept = 2; // 24 MiB each
} // namespace

EnvironmentResolver::EnvironmentResolver(TaskRunner& runner, QObject* parent)
    : QObject(parent)
    , m_tasks(runner) {
    m_rest.setSingleShot(true);
    m_rest.setInterval(kRestMs);
    connect(&m_rest, &QTimer::timeout, this, &EnvironmentResolver::refine);
}

void EnvironmentResolver::reset(const Document& document) {
    change(); // what is under way belongs to the document that goes
    m_recipe = environmentRecipe(document.environment);
    m_blend = environmentBlend(document);
    m_shown = shownEnvironment(document).image;
    m_imageIsDraft = m_blendIsDraft = false;
    m_made.clear();
    m_drafts.clear();
}

bool EnvironmentResolver::update(Document& document) {
    const bool imageChanged = updateImage(document.environment);
    const bool blendChanged = updateBlend(document);
    if (imageChanged || blendChanged) {
        change();
        if (m_imageIsDraft || m_blendIsDraft)
            m_rest.start();
    }
    ImagePtr shown = shownEnvironment(document).image;
    return std::exchange(m_shown, shown) != shown;
}

// What is under way is not wanted any more.
void EnvironmentResolver::change() {
    m_tasks.cancelAll();
    m_rest.stop();
}

bool EnvironmentResolver::updateImage(Environment& environment) {
    EnvironmentRecipe recipe = environmentRecipe(environment);
    if (recipe == m_recipe)
        return false;
    m_recipe = std::move(recipe);
    m_imageIsDraft = false;
    ImagePtr image = environment.fileImage;
    if (m_recipe.kind != EnvironmentKind::Image) {
        const auto made = std::find_if(m_made.begin(), m_made.end(),
                                       [&](const Made& m) { return m.recipe == m_recipe; });
        m_imageIsDraft = made == m_made.end();
        image =
            m_imageIsDraft ? generateEnvironment(m_recipe, kDraftEnvironmentHeight) : made->image;
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
    document.environment.blended = nullptr;
    if (m_blend) {
        EnvironmentBlend small = *m_blend;
        small.first = draftOf(small.first);
        small.second = draftOf(small.second);
        document.environment.blended = blendEnvironments(small);
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

// The picture of both follows when that of the first environment is there.
void EnvironmentResolver::refine() {
    m_tasks.run(
        {.tag = "environment image", .priority = TaskPriority::Low},
        [recipe = m_recipe, blend = m_blend, ofBoth = !m_imageIsDraft](const JobContext& job) {
            return ofBoth ? blendEnvironments(*blend, job)
                          : generateEnvironment(recipe, kEnvironmentHeight, job);
        },
        [this](const Result<ImagePtr>& image) {
            if (image && *image) // else the draft stays
                deliver(*image);
        });
}

void EnvironmentResolver::deliver(const ImagePtr& image) {
    if (!m_imageIsDraft) {
        m_blendIsDraft = false;
        m_shown = image;
        Q_EMIT blended(image);
        return;
    }
    m_imageIsDraft = false;
    m_made.push_back({m_recipe, image});
    if (m_made.size() > kKept)
        m_made.pop_front();
    Q_EMIT refined(image);
}

} // namespace patina::editor
