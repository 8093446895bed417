// The library of environments: the HDR files of the user's folders and the built-in skies, measured
// in the background, in the order and selection that the Library dock shows. Page Up and Page Down
// step through it whether the dock is open or not.
#pragma once

#include "core/catalog/CatalogCache.h"
#include "core/catalog/CatalogEntry.h"
#include "core/catalog/CatalogOrder.h"
#include "core/edit/EditStep.h"
#include "core/job/TaskRunner.h"

#include <QObject>
#include <QSet>
#include <QString>
#include <QStringList>
#include <QTimer>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace patina {
struct Change;
}

namespace patina::editor {

class DocumentController;

// Where an environment library keeps what it has measured.
[[nodiscard]] std::filesystem::path libraryCacheFolder();

struct LibraryFolder {
    QString path; // absolute; empty: the built-in skies
    bool shown = true;
    int found = 0;   // environments
    QString problem; // why it cannot be read, or what of it is left out
};

struct LibraryItem {
    QString source; // absolute path or "builtin:NAME"
    QString folder; // LibraryFolder::path
    // Measured, or with no more than its title while it is not.
    CatalogEntryPtr entry;
    bool measured = false;
    QString problem;     // why it cannot be read; empty: it can, as far as is known
    QString duplicateOf; // the title of the first that is the same light; empty: none
};

class EnvironmentLibrary : public QObject {
    Q_OBJECT
  public:
    static constexpr int kMostItems = 1000, kLevels = 4;

    // Folders, order and favourites are those of the settings. Nothing is read before load().
    EnvironmentLibrary(DocumentController& controller, std::filesystem::path cacheFolder,
                       QObject* parent = nullptr);

    void load(); // the first time it is called
    void rescan();

    // --- Folders, the built-in skies first -------------------------------------------------------
    [[nodiscard]] const std::vector<LibraryFolder>& folders() const { return m_folders; }
    void addFolder(const QString& path); // shown, also when it was there
    void removeFolder(const QString& path);
    void setFolderShown(const QString& path, bool shown);

    // --- What is shown ---------------------------------------------------------------------------
    [[nodiscard]] const std::vector<LibraryItem>& items() const { return m_items; }
    [[nodiscard]] const std::vector<std::size_t>& shown() const { return m_shown; } // of items()
    [[nodiscard]] const LibraryItem* item(const QString& source) const;
    [[nodiscard]] std::vector<const LibraryItem*> unreadable() const;
    struct Query {
        QString search;
        bool favouritesOnly = false;
        CatalogSort sort = CatalogSort::Name;
        bool descending = false;
        friend bool operator==(const Query&, const Query&) = default;
    };
    [[nodiscard]] const Query& query() const { return m_query; }
    void setQuery(const Query& query);
    [[nodiscard]] bool isFavourite(const QString& source) const;
    void setFavourite(const QString& source, bool favourite);

    [[nodiscard]] bool isListing() const { return m_tasks.busy(kListTask); }
    [[nodiscard]] int leftToMeasure() const; // 0: all is measured
    [[nodiscard]] bool busy() const { return m_tasks.busy() || m_refresh.isActive(); }

    // --- Light -----------------------------------------------------------------------------------
    // Of the environment that lights the scene: an item's source, or empty.
    [[nodiscard]] QString current() const;
    [[nodiscard]] float rotationDeg() const { return m_rotationDeg; } // of current()
    [[nodiscard]] DocumentController& controller() { return m_controller; }
    void use(const QString& source); // one undo step
    void addToScene(const QString& source);
    // The next one (1) or the one before (-1) in the order that is shown, around its end; steps
    // that follow each other are one undo step.
    void step(int by);
    void stepTo(const QString& source); // to this one

  Q_SIGNALS:
    void foldersChanged();
    void itemsChanged();   // entries, their order or which are shown
    void currentChanged(); // what lights the scene, or is about to
    void rotated();        // rotationDeg()
    void arrived();        // what was used or stepped to lights the scene; nobody has drawn it yet

  private:
    static constexpr const char* kListTask = "list of the library";
    static constexpr const char* kCompareTask = "duplicates in the library";
    struct Listing;

    [[nodiscard]] Listing list(std::vector<LibraryFolder> folders, const JobContext& job) const;
    void take(Listing listing);
    void measureNext(int lane);
    void takeMeasured(std::size_t index, Result<CatalogEntry> entry);
    void compare();
    void refresh();
    void refreshSoon();
    void saveFolders() const;
    void follow(const Change& change);
    LibraryFolder* folder(const QString& path);

    DocumentController& m_controller;
    CatalogCache m_cache;
    std::vector<LibraryFolder> m_folders;
    std::vector<LibraryItem> m_items;
    std::vector<std::size_t> m_shown;
    std::deque<std::size_t> m_toMeasure;
    Query m_query;
    QSet<QString> m_favourites;
    bool m_loaded = false, m_compared = true;
    QString m_current, m_asked; // what lights the scene; what is being read to light it
    float m_rotationDeg = 0.0f;
    int m_stepsWaiting = 0; // asked for before there was a list
    DragSession m_stepSession = 0;
    QTimer m_refresh;
    TaskGroup m_tasks; // last: what it runs uses the rest
};

} // namespace patina::editor
