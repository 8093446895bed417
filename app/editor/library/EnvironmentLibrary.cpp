#include "app/editor/library/EnvironmentLibrary.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/QtText.h"
#include "core/base/Log.h"
#include "core/document/Document.h"
#include "core/document/EnvironmentTitle.h"
#include "core/document/Source.h"
#include "core/library/Library.h"
#include "core/scene/FolderEnvironments.h"

#include <QDir>
#include <QFileInfo>
#include <QSettings>
#include <QStandardPaths>
#include <algorithm>
#include <utility>

namespace patina::editor {
namespace {

constexpr int kLanes = 2;      // files that are read and measured at a time
constexpr int kGatherMs = 100; // of changes, so that a grid is not laid out for each file
const char* const kFoldersKey = "library/folders";
const char* const kHiddenKey = "library/hiddenFolders";
const char* const kFavouritesKey = "library/favourites";
const char* const kSortKey = "library/sort";
const char* const kDescendingKey = "library/descending";

std::string laneTag(int lane) {
    return "measuring of the library " + std::to_string(lane);
}

// Known before the file is read.
CatalogEntryPtr titleAlone(const std::string& source) {
    Environment environment;
    environment.source = source;
    CatalogEntry entry;
    entry.source = source;
    entry.title = environmentTitle(environment);
    return std::make_shared<const CatalogEntry>(std::move(entry));
}

// What a path is called in a message of an item or folder that has its name beside it.
QString reasonOf(const Error& error) {
    QString reason = toQString(error.message);
    if (!error.detail.empty())
        reason += QStringLiteral(" (%1)").arg(toQString(error.detail));
    return reason;
}

// As an item's; empty where a sky or softboxes light the scene.
QString sourceLighting(const Document& document) {
    const Environment& lit = document.environment();
    if (lit.kind != EnvironmentKind::Image)
        return {};
    return isBuiltin(lit.source) ? toQString(lit.source) : fromPath(lit.source);
}

} // namespace

std::filesystem::path libraryCacheFolder() {
    const QString folder = QStandardPaths::writableLocation(QStandardPaths::CacheLocation);
    return toPath(folder) / "library";
}

// What the disk has, and what of it was measured before.
struct EnvironmentLibrary::Listing {
    std::vector<LibraryFolder> folders;
    std::vector<LibraryItem> items;
};

EnvironmentLibrary::EnvironmentLibrary(DocumentController& controller,
                                       std::filesystem::path cacheFolder, QObject* parent)
    : QObject(parent)
    , m_controller(controller)
    , m_cache(std::move(cacheFolder))
    , m_tasks(controller.runner()) {
    const QSettings settings;
    const QStringList hidden = settings.value(QLatin1String(kHiddenKey)).toStringList();
    m_folders.push_back({{}, !hidden.contains(QString()), 0, {}});
    for (const QString& path : settings.value(QLatin1String(kFoldersKey)).toStringList())
        m_folders.push_back({path, !hidden.contains(path), 0, {}});
    const QStringList favourites = settings.value(QLatin1String(kFavouritesKey)).toStringList();
    m_favourites = QSet<QString>(favourites.begin(), favourites.end());
    m_query.sort = static_cast<CatalogSort>(
        std::clamp(settings.value(QLatin1String(kSortKey)).toInt(), 0, kCatalogSorts - 1));
    m_query.descending = settings.value(QLatin1String(kDescendingKey)).toBool();
    m_refresh.setSingleShot(true);
    m_refresh.setInterval(kGatherMs);
    connect(&m_refresh, &QTimer::timeout, this, &EnvironmentLibrary::refresh);
    connect(&controller, &DocumentController::changed, this, &EnvironmentLibrary::follow);
}

// --- Reading -------------------------------------------------------------------------------------

void EnvironmentLibrary::load() {
    if (std::exchange(m_loaded, true))
        return;
    if (!m_controller.document().environments.empty()) { // empty: nothing was open yet
        m_current = sourceLighting(m_controller.document());
        m_rotationDeg = m_controller.document().environment().rotationDeg;
    }
    rescan();
}

void EnvironmentLibrary::rescan() {
    m_loaded = true;
    for (int lane = 0; lane < kLanes; ++lane)
        m_tasks.cancel(laneTag(lane));
    m_tasks.cancel(kCompareTask);
    m_toMeasure.clear();
    m_tasks.run(
        {.tag = kListTask, .priority = TaskPriority::Normal},
        [this, folders = m_folders](const JobContext& job) { return list(folders, job); },
        [this](Result<Listing> listing) {
            if (listing)
                take(std::move(*listing));
        });
    Q_EMIT foldersChanged(); // they are being read
}

// On a thread of the pool: of this only what never changes is used.
EnvironmentLibrary::Listing EnvironmentLibrary::list(std::vector<LibraryFolder> folders,
                                                     const JobContext& job) const {
    Listing listing;
    QSet<QString> known;
    const auto add = [&](const std::string& source, const QString& folder) {
        LibraryItem item;
        item.source = isBuiltin(source) ? toQString(source) : fromPath(source);
        if (known.contains(item.source)) // of a folder within another
            return false;
        known.insert(item.source);
        item.folder = folder;
        const Result<Hash> key = catalogKey(source);
        std::optional<CatalogEntry> kept = key ? m_cache.find(*key) : std::nullopt;
        item.measured = kept.has_value();
        item.entry =
            kept ? std::make_shared<const CatalogEntry>(std::move(*kept)) : titleAlone(source);
        if (!key)
            item.problem = reasonOf(key.error());
        listing.items.push_back(std::move(item));
        return true;
    };
    for (LibraryFolder& folder : folders) {
        folder.found = 0;
        folder.problem.clear();
        if (folder.path.isEmpty()) {
            for (const library::Entry& sky : library::environments())
                folder.found += add("builtin:" + sky.name, {}) ? 1 : 0;
            continue;
        }
        const Result<FolderEnvironments> found = environmentFilesOf(
            toPath(folder.path), {.levels = kLevels, .mostFiles = kMostItems}, job);
        if (!found) {
            folder.problem = reasonOf(found.error());
            continue;
        }
        bool complete = found->complete;
        for (const std::filesystem::path& file : found->files) {
            if (job.cancelled())
                return listing;
            complete = complete && static_cast<int>(listing.items.size()) < kMostItems;
            if (static_cast<int>(listing.items.size()) >= kMostItems)
                break;
            folder.found += add(file.string(), folder.path) ? 1 : 0;
        }
        if (!complete)
            folder.problem = tr("Not all of its environments are shown: the library holds at "
                                "most %1. Add folders with fewer files.")
                                 .arg(kMostItems);
        else if (!found->unreadable.empty())
            folder.problem =
                tr("Folders in it cannot be read: %1").arg(fromPath(found->unreadable.front()));
    }
    listing.folders = std::move(folders);
    return listing;
}

void EnvironmentLibrary::take(Listing listing) {
    for (const LibraryFolder& read : listing.folders)
        if (LibraryFolder* own = folder(read.path)) { // it may be hidden meanwhile
            own->found = read.found;
            own->problem = read.problem;
        }
    m_items = std::move(listing.items);
    m_compared = false;
    refresh(); // what is shown are places among the items
    for (std::size_t i = 0; i < m_items.size(); ++i)
        if (!m_items[i].measured && m_items[i].problem.isEmpty())
            m_toMeasure.push_back(i);
    for (int lane = 0; lane < kLanes; ++lane)
        measureNext(lane);
    Q_EMIT foldersChanged();
    if (const int steps = std::exchange(m_stepsWaiting, 0); steps != 0)
        step(steps);
}

void EnvironmentLibrary::measureNext(int lane) {
    if (m_toMeasure.empty()) {
        compare();
        return;
    }
    const std::size_t index = m_toMeasure.front();
    m_toMeasure.pop_front();
    const QString source = m_items[index].source;
    m_tasks.run(
        {.tag = laneTag(lane), .priority = TaskPriority::Low},
        [this, source](const JobContext& job) -> Result<CatalogEntry> {
            const std::string name = source.startsWith(QLatin1String("builtin:"))
                                         ? source.toStdString()
                                         : toPath(source).string();
            const Result<Hash> key = catalogKey(name); // before it is read: it may change meanwhile
            if (!key)
                return key.error();
            Result<CatalogEntry> entry = makeCatalogEntry(m_controller.worker(), name, job);
            if (entry)
                if (const Result<void> kept = m_cache.store(*key, *entry); !kept)
                    logInfo("What was measured of {} could not be kept for next time: {}", name,
                            kept.error().text());
            return entry;
        },
        [this, index, lane](Result<CatalogEntry> entry) {
            takeMeasured(index, std::move(entry));
            measureNext(lane);
        });
}

void EnvironmentLibrary::takeMeasured(std::size_t index, Result<CatalogEntry> entry) {
    LibraryItem& item = m_items[index];
    if (entry) {
        item.entry = std::make_shared<const CatalogEntry>(std::move(*entry));
        item.measured = true;
    } else {
        item.problem = reasonOf(entry.error());
    }
    refreshSoon();
}

// Which are the same light: when all are measured.
void EnvironmentLibrary::compare() {
    if (m_compared || leftToMeasure() > 0)
        return;
    m_compared = true;
    std::vector<std::size_t> places;
    std::vector<CatalogEntryPtr> entries;
    for (std::size_t i = 0; i < m_items.size(); ++i)
        if (m_items[i].measured) {
            places.push_back(i);
            entries.push_back(m_items[i].entry);
        }
    m_tasks.run(
        {.tag = kCompareTask, .priority = TaskPriority::Low},
        [entries](const JobContext& job) { return findSameEntries(entries, job); },
        [this, places](const Result<std::vector<std::optional<SameEntry>>>& same) {
            if (!same)
                return;
            for (std::size_t i = 0; i < places.size(); ++i)
                m_items[places[i]].duplicateOf =
                    (*same)[i] ? toQString(m_items[places[(*same)[i]->of]].entry->title)
                               : QString();
            refresh();
        });
}

int EnvironmentLibrary::leftToMeasure() const {
    return static_cast<int>(std::ranges::count_if(
        m_items, [](const LibraryItem& item) { return !item.measured && item.problem.isEmpty(); }));
}

// --- Folders -------------------------------------------------------------------------------------

LibraryFolder* EnvironmentLibrary::folder(const QString& path) {
    const auto found = std::ranges::find(m_folders, path, &LibraryFolder::path);
    return found == m_folders.end() ? nullptr : &*found;
}

void EnvironmentLibrary::addFolder(const QString& path) {
    const QString absolute = QDir::cleanPath(QFileInfo(path).absoluteFilePath());
    if (LibraryFolder* known = folder(absolute))
        known->shown = true;
    else
        m_folders.push_back({absolute, true, 0, {}});
    saveFolders();
    rescan();
}

void EnvironmentLibrary::removeFolder(const QString& path) {
    if (path.isEmpty() ||
        std::erase_if(m_folders, [&](const LibraryFolder& f) { return f.path == path; }) == 0)
        return;
    saveFolders();
    rescan();
}

void EnvironmentLibrary::setFolderShown(const QString& path, bool shown) {
    LibraryFolder* changed = folder(path);
    if (!changed || changed->shown == shown)
        return;
    changed->shown = shown;
    saveFolders();
    refresh();
}

void EnvironmentLibrary::saveFolders() const {
    QStringList paths, hidden;
    for (const LibraryFolder& each : m_folders) {
        if (!each.path.isEmpty())
            paths << each.path;
        if (!each.shown)
            hidden << each.path;
    }
    QSettings settings;
    settings.setValue(QLatin1String(kFoldersKey), paths);
    settings.setValue(QLatin1String(kHiddenKey), hidden);
}

// --- What is shown -------------------------------------------------------------------------------

void EnvironmentLibrary::refreshSoon() {
    if (!m_refresh.isActive())
        m_refresh.start();
}

void EnvironmentLibrary::refresh() {
    m_refresh.stop();
    const std::string search = m_query.search.toStdString();
    std::vector<std::size_t> measured, waiting;
    for (std::size_t i = 0; i < m_items.size(); ++i) {
        const LibraryItem& item = m_items[i];
        const LibraryFolder* home = folder(item.folder);
        if (!item.problem.isEmpty() || !home || !home->shown ||
            (m_query.favouritesOnly && !isFavourite(item.source)) ||
            !matchesSearch(*item.entry, !item.duplicateOf.isEmpty(), search))
            continue;
        // By name those that are not measured have their place already.
        (item.measured || m_query.sort == CatalogSort::Name ? measured : waiting).push_back(i);
    }
    m_shown.clear();
    const auto append = [this](const std::vector<std::size_t>& places, CatalogSort sort) {
        std::vector<CatalogEntryPtr> entries;
        for (const std::size_t i : places)
            entries.push_back(m_items[i].entry);
        for (const std::size_t i : sortedEntries(entries, sort, m_query.descending))
            m_shown.push_back(places[i]);
    };
    append(measured, m_query.sort);
    append(waiting, CatalogSort::Name);
    Q_EMIT itemsChanged();
}

const LibraryItem* EnvironmentLibrary::item(const QString& source) const {
    const auto found = std::ranges::find(m_items, source, &LibraryItem::source);
    return found == m_items.end() ? nullptr : &*found;
}

std::vector<const LibraryItem*> EnvironmentLibrary::unreadable() const {
    std::vector<const LibraryItem*> result;
    for (const LibraryItem& each : m_items)
        if (!each.problem.isEmpty())
            result.push_back(&each);
    return result;
}

void EnvironmentLibrary::setQuery(const Query& query) {
    if (m_query == query)
        return;
    m_query = query;
    QSettings settings;
    settings.setValue(QLatin1String(kSortKey), static_cast<int>(query.sort));
    settings.setValue(QLatin1String(kDescendingKey), query.descending);
    refresh();
}

bool EnvironmentLibrary::isFavourite(const QString& source) const {
    return m_favourites.contains(source);
}

void EnvironmentLibrary::setFavourite(const QString& source, bool favourite) {
    if (favourite == isFavourite(source))
        return;
    if (favourite)
        m_favourites.insert(source);
    else
        m_favourites.remove(source);
    QStringList kept(m_favourites.begin(), m_favourites.end());
    kept.sort();
    QSettings().setValue(QLatin1String(kFavouritesKey), kept);
    refresh();
}

// --- Light ---------------------------------------------------------------------------------------

QString EnvironmentLibrary::current() const {
    return m_asked.isEmpty() ? m_current : m_asked;
}

void EnvironmentLibrary::follow(const Change& change) {
    if (change.target && change.target->scope != Scope::Environment)
        return;
    if (change.isAnotherDocument())
        m_stepSession = 0;
    const QString now = sourceLighting(m_controller.document());
    const float rotation = m_controller.document().environment().rotationDeg;
    if (std::exchange(m_rotationDeg, rotation) != rotation)
        Q_EMIT rotated();
    // It is there, or will not come: the controller says so when it cannot be read.
    const QString before = current();
    const bool arrives = !m_asked.isEmpty() && now == m_asked && now != m_current;
    if (now != std::exchange(m_current, now) || change.affects == Affects::Nothing)
        m_asked.clear();
    if (arrives)
        Q_EMIT arrived();
    if (current() != before)
        Q_EMIT currentChanged();
}

void EnvironmentLibrary::use(const QString& source) {
    // Steps after this are others.
    const bool steppedTo = std::exchange(m_stepSession, 0) != 0 && source == current();
    if (steppedTo)
        return; // it is what lights the scene, or is on its way
    m_asked = source;
    m_controller.setEnvironment(source);
    Q_EMIT currentChanged();
}

void EnvironmentLibrary::addToScene(const QString& source) {
    m_controller.addEnvironment(source, DocumentController::EnvironmentUse::Light);
}

void EnvironmentLibrary::step(int by) {
    if (m_items.empty()) { // they are being listed
        m_stepsWaiting += by;
        load();
        return;
    }
    if (m_shown.empty())
        return;
    const auto at =
        std::ranges::find(m_shown, current(), [this](std::size_t i) { return m_items[i].source; });
    const auto count = static_cast<std::ptrdiff_t>(m_shown.size());
    // From elsewhere to the first, or to the last.
    const std::ptrdiff_t from = at == m_shown.end() ? (by > 0 ? -1 : count) : at - m_shown.begin();
    const std::ptrdiff_t to = ((from + by) % count + count) % count;
    stepTo(m_items[m_shown[static_cast<std::size_t>(to)]].source);
}

void EnvironmentLibrary::stepTo(const QString& source) {
    if (source == current())
        return;
    if (m_stepSession == 0)
        m_stepSession = m_controller.newDragSession();
    m_asked = source;
    m_controller.setEnvironment(source, m_stepSession);
    Q_EMIT currentChanged();
}

} // namespace patina::editor
