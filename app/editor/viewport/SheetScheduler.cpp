#include "app/editor/viewport/SheetScheduler.h"

#include "core/base/Check.h"
#include "core/base/Log.h"

#include <QElapsedTimer>
#include <algorithm>

namespace patina::editor {
namespace {

// A pass holds up the hand that begins to move: fewer views when it takes longer than this.
// Qt puts the window together anew after it, which takes as long again.
constexpr double kLongMs = 20.0;
constexpr double kShortMs = 4.0; // and never because of this

QImage toQImage(const Image& image) {
    CHECK(image.channels() == 4 && image.type() == PixelType::U8);
    // A copy: the image's bytes do not live as long.
    return QImage(image.u8().data(), image.width(), image.height(), 4 * image.width(),
                  QImage::Format_RGBA8888)
        .copy();
}

} // namespace

SheetScheduler::SheetScheduler(FrameSchedule& schedule, QObject* parent)
    : QObject(parent)
    , m_pass(schedule, [this] { drawNext(); }) {}

void SheetScheduler::add(SheetClient& client) {
    m_entries.push_back({&client, {}, {}});
    wake();
}

void SheetScheduler::remove(SheetClient& client) {
    std::erase_if(m_entries, [&](const Entry& entry) { return entry.client == &client; });
}

std::vector<ViewKind> SheetScheduler::wanted() const {
    std::vector<ViewKind> kinds;
    for (const Entry& entry : m_entries) {
        const render::ViewSheet sheet = entry.client->wantedSheet();
        kinds.insert(kinds.end(), sheet.kinds.begin(), sheet.kinds.end());
    }
    return kinds;
}

void SheetScheduler::wake() {
    if (m_resting && !m_pass.isWanted())
        m_pass.want();
}

void SheetScheduler::invalidate() {
    ++m_version;
    wake();
}

void SheetScheduler::setResting(bool resting) {
    m_resting = resting;
    if (resting)
        wake();
    else
        m_pass.drop();
}

render::ViewSheet SheetScheduler::nextSheet(Entry& entry) {
    render::ViewSheet sheet = entry.client->wantedSheet();
    render::ViewSheet& format = entry.format;
    if (sheet.mode != format.mode || sheet.width != format.width || sheet.height != format.height) {
        entry.drawnVersion.clear();
        format = {{}, sheet.mode, sheet.width, sheet.height};
    }
    std::erase_if(sheet.kinds, [&](ViewKind kind) {
        const auto drawn = entry.drawnVersion.find(kind);
        return drawn != entry.drawnVersion.end() && drawn->second == m_version;
    });
    if (sheet.width <= 0 || sheet.height <= 0)
        sheet.kinds.clear();
    if (m_ready && std::erase_if(sheet.kinds, [&](ViewKind kind) { return !m_ready(kind); }) > 0)
        m_waits = true;
    if (sheet.kinds.size() > static_cast<std::size_t>(m_passViews))
        sheet.kinds.resize(static_cast<std::size_t>(m_passViews));
    return sheet;
}

void SheetScheduler::drawNext() {
    if (!m_resting || !m_draw)
        return;
    m_waits = false;
    for (std::size_t i = 0; i < m_entries.size(); ++i) {
        const std::size_t index = (m_turn + i) % m_entries.size();
        Entry& entry = m_entries[index];
        const render::ViewSheet sheet = nextSheet(entry);
        if (sheet.kinds.empty())
            continue;
        m_turn = index + 1;

        QElapsedTimer clock;
        clock.start();
        const quint64 version = m_version;
        const Result<std::vector<Image>> drawn = m_draw(sheet);
        const double milliseconds = static_cast<double>(clock.nsecsElapsed()) * 1e-6;
        // What failed is not tried again before the scene changes.
        for (const ViewKind kind : sheet.kinds)
            entry.drawnVersion[kind] = version;
        const double longMs =
            m_frameMs > 0.0 ? std::clamp(kShare * m_frameMs, kShortMs, kLongMs) : kLongMs;
        if (milliseconds > longMs)
            m_passViews = std::max(1, m_passViews / 2);
        else if (milliseconds < longMs / 4)
            m_passViews = std::min(kPassViews, 2 * m_passViews);
        m_pass.want(pauseAfterMs(milliseconds));

        if (!drawn) {
            logError("thumbnails could not be drawn: {}", drawn.error().text());
            return;
        }
        CHECK(drawn->size() == sheet.kinds.size());
        SheetClient& client = *entry.client; // a client may add or remove others
        for (std::size_t k = 0; k < sheet.kinds.size(); ++k)
            client.showThumbnail(sheet.kinds[k], toQImage((*drawn)[k]));
        Q_EMIT passDrawn(static_cast<int>(sheet.kinds.size()), milliseconds);
        return;
    }
    if (!m_waits)
        Q_EMIT allDrawn();
}

} // namespace patina::editor
