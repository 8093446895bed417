#include "app/editor/document/EnvironmentResolver.h"

#include "core/job/Parallel.h"

#include <algorithm>

namespace patina::editor {
namespace {
constexpr int kRestMs = 200;
constexpr std::size_t kKept = 2; // 24 MiB each
} // namespace

EnvironmentResolver::EnvironmentResolver(QObject* parent)
    : QObject(parent) {
    m_pool.setMaxThreadCount(1); // newest wins: a cancelled picture ends quickly
    m_rest.setSingleShot(true);
    m_rest.setInterval(kRestMs);
    connect(&m_rest, &QTimer::timeout, this, &EnvironmentResolver::refine);
}

EnvironmentResolver::~EnvironmentResolver() {
    m_control.cancel();
    m_pool.waitForDone();
}

void EnvironmentResolver::reset(const Environment& environment) {
    m_control.cancel();
    m_rest.stop();
    ++m_request; // what is under way belongs to the document that goes
    m_recipe = environmentRecipe(environment);
    m_made.clear();
}

bool EnvironmentResolver::update(Environment& environment) {
    EnvironmentRecipe recipe = environmentRecipe(environment);
    if (recipe == m_recipe)
        return false;
    m_recipe = std::move(recipe);
    m_control.cancel();
    m_rest.stop();
    ++m_request;

    ImagePtr image = environment.fileImage;
    if (m_recipe.kind != EnvironmentKind::Image) {
        const auto made = std::find_if(m_made.begin(), m_made.end(),
                                       [&](const Made& m) { return m.recipe == m_recipe; });
        if (made != m_made.end()) {
            image = made->image;
        } else {
            image = generateEnvironment(m_recipe, kDraftEnvironmentHeight);
            m_rest.start();
        }
    }
    if (!image || image == environment.image)
        return false;
    environment.image = std::move(image);
    return true;
}

void EnvironmentResolver::refine() {
    m_control = JobControl();
    m_pool.start([this, id = m_request, recipe = m_recipe, job = m_control.context()] {
        lowerThreadPriority();
        const ImagePtr image = generateEnvironment(recipe, kEnvironmentHeight, job);
        // The destructor waits for the pool, so `this` is alive.
        QMetaObject::invokeMethod(
            this, [this, id, image] { deliver(id, image); }, Qt::QueuedConnection);
    });
}

void EnvironmentResolver::deliver(quint64 request, const ImagePtr& image) {
    if (request != m_request || !image)
        return;
    m_made.push_back({m_recipe, image});
    if (m_made.size() > kKept)
        m_made.pop_front();
    Q_EMIT refined(image);
}

} // namespace patina::editor
