#include "app/editor/library/LibraryPanel.h"

#include "app/editor/Actions.h"
#include "app/editor/FileFlow.h"
#include "app/editor/document/DraggedSources.h"
#include "app/editor/document/QtText.h"
#include "app/editor/library/EnvironmentLibrary.h"
#include "app/editor/library/EnvironmentPreview.h"
#include "app/editor/library/LibraryDelegate.h"
#include "app/editor/library/LibraryGestures.h"
#include "app/editor/library/LibraryModel.h"
#include "app/editor/library/LibraryTexts.h"
#include "app/editor/library/LibraryView.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/ElidedLabel.h"
#include "app/editor/widget/ListButton.h"

#include <QBoxLayout>
#include <QClipboard>
#include <QComboBox>
#include <QDir>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QGuiApplication>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QScrollBar>
#include <QSettings>
#include <QSignalBlocker>
#include <QToolButton>
#include <algorithm>

namespace patina::editor {
namespace {

constexpr int kSideWidth = 184;  // folders beside the grid
constexpr int kSideHeight = 132; // or above it
constexpr int kWideFrom = 520;
constexpr int kUnreadableHeight = 96;
constexpr int kPathRole = Qt::UserRole;
const char* const kLibraryFolderKey = "folders/library";

QStringList foldersOf(const QMimeData& data) {
    QStringList folders = draggedFiles(data);
    folders.removeIf([](const QString& file) { return !QFileInfo(file).isDir(); });
    return folders;
}

QToolButton* makeToggle(const QString& iconName, const QString& name, const QString& help) {
    QToolButton* button = makeListButton(iconName, {}, help);
    button->setAccessibleName(name);
    button->setCheckable(true);
    return button;
}

} // namespace

LibraryPanel::LibraryPanel(EnvironmentLibrary& library, EnvironmentPreview& preview,
                           QWidget* parent)
    : QWidget(parent)
    , m_library(library)
    , m_preview(preview)
    , m_model(new LibraryModel(library, this))
    , m_folders(new QListWidget)
    , m_unreadable(new QListWidget)
    , m_removeFolder(makeListButton(QStringLiteral("remove"), {},
                                    tr("Remove the folder from the library; its files stay")))
    , m_unreadableToggle(new QToolButton)
    , m_progress(new QLabel)
    , m_search(new QLineEdit)
    , m_favourites(
          makeToggle(QStringLiteral("star"), tr("Favourites only"), tr("Show favourites alone")))
    , m_descending(makeToggle(QStringLiteral("sort-descending"), tr("Descending"),
                              tr("Show the largest first, or names from Z to A")))
    , m_sort(new QComboBox)
    , m_view(new LibraryView)
    , m_name(new ElidedLabel)
    , m_measures(new ElidedLabel)
    , m_side(makeFolders())
    , m_layout(new QBoxLayout(QBoxLayout::TopToBottom, this)) {
    setAcceptDrops(true);
    auto* delegate = new LibraryDelegate(m_view);
    m_view->setModel(m_model);
    m_view->setItemDelegate(delegate);
    m_view->setAccessibleName(tr("Environments"));
    m_view->setStatusTip(
        tr("Double-click, or step with the arrow keys, to light the scene with an environment"));
    m_name->setAccessibleName(tr("Environment that is chosen"));
    m_measures->setAccessibleName(tr("Measured of the environment"));
    for (QLabel* line : {m_name, m_measures})
        line->setStatusTip(tr("What was measured of the environment that is chosen; hold the "
                              "pointer still for all of it"));

    auto* content = new QWidget;
    auto* column = new QVBoxLayout(content);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(tokens::kGap / 2);
    column->addWidget(makeQuery());
    column->addWidget(m_view, 1);
    column->addWidget(m_name);
    column->addWidget(m_measures);
    m_layout->setContentsMargins(tokens::kGap, tokens::kGap / 2, tokens::kGap, tokens::kGap);
    m_layout->setSpacing(tokens::kGap);
    m_layout->addWidget(m_side);
    m_layout->addWidget(content, 1);

    connect(delegate, &LibraryDelegate::starClicked, this, [this](const QString& source) {
        m_library.setFavourite(source, !m_library.isFavourite(source));
    });
    new LibraryGestures(library, preview, *m_view, *this);
    connect(m_view, &LibraryView::useRequested, &library, &EnvironmentLibrary::use);
    connect(m_view, &LibraryView::stepRequested, &library, &EnvironmentLibrary::stepTo);
    connect(m_view, &LibraryView::menuRequested, this, &LibraryPanel::openMenu);
    connect(m_view, &LibraryView::currentSourceChanged, this, [this] {
        if (!m_refreshing && m_view->currentIndex().isValid())
            m_chosen = m_view->currentSource();
        refreshDetails();
    });
    connect(m_model, &QAbstractItemModel::modelAboutToBeReset, this, [this] {
        m_refreshing = true;
        m_scrolled = m_view->verticalScrollBar()->value();
    });
    connect(m_model, &QAbstractItemModel::modelReset, this, [this] {
        // At first what lights the scene.
        const QString chosen = m_chosen.isEmpty() ? m_library.current() : m_chosen;
        if (const QModelIndex index = m_model->indexOf(chosen); index.isValid())
            m_view->setCurrentIndex(index);
        // What is measured meanwhile must not move the grid away from where somebody looks.
        if (!m_asking) {
            m_view->doItemsLayout();
            m_view->verticalScrollBar()->setValue(m_scrolled);
        }
        m_refreshing = false;
    });
    connect(&library, &EnvironmentLibrary::itemsChanged, this, &LibraryPanel::refreshItems);
    connect(&library, &EnvironmentLibrary::foldersChanged, this, &LibraryPanel::refreshFolders);
    connect(&library, &EnvironmentLibrary::currentChanged, this, [this] {
        // What was stepped to is chosen, too.
        if (const QModelIndex index = m_model->indexOf(m_library.current()); index.isValid())
            m_view->setCurrentIndex(index);
    });
    refreshFolders();
    refreshItems();
}

QWidget* LibraryPanel::makeFolders() {
    QToolButton* add = makeListButton(
        QStringLiteral("add"), tr("Folder…"),
        tr("Add a folder of HDR or EXR environments and the folders in it to the library; or drop "
           "one here"));
    add->setAccessibleName(tr("Add a folder"));
    QToolButton* rescan =
        makeListButton(QStringLiteral("refresh"), {}, tr("Look for new and changed files"));
    rescan->setAccessibleName(tr("Look for changes"));
    m_removeFolder->setAccessibleName(tr("Remove the folder"));
    m_folders->setAccessibleName(tr("Folders of the library"));
    m_folders->setStatusTip(tr("Tick the folders whose environments are shown"));
    m_folders->setToolTip(m_folders->statusTip());
    m_folders->setTextElideMode(Qt::ElideMiddle);
    m_folders->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    m_unreadable->setAccessibleName(tr("Files that cannot be read"));
    m_unreadable->setStatusTip(tr("Files of the folders that cannot be read, and why"));
    m_unreadable->setToolTip(m_unreadable->statusTip());
    m_unreadable->setWordWrap(true);
    m_unreadable->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    m_unreadable->setSelectionMode(QAbstractItemView::NoSelection);
    m_unreadable->setMaximumHeight(kUnreadableHeight);
    m_unreadable->hide();
    m_unreadableToggle->setCheckable(true);
    m_unreadableToggle->setIcon(icon(QStringLiteral("warning"), tokens::kCopper));
    m_unreadableToggle->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    m_unreadableToggle->setAutoRaise(true);
    m_unreadableToggle->setFocusPolicy(Qt::TabFocus);
    m_unreadableToggle->setToolTip(tr("List the files that cannot be read, and why"));
    m_unreadableToggle->setStatusTip(m_unreadableToggle->toolTip());
    m_unreadableToggle->hide();
    m_progress->setAccessibleName(tr("Progress of the library"));
    m_progress->setStatusTip(tr("How far the environments are read and measured"));
    m_progress->setToolTip(m_progress->statusTip());
    m_progress->hide();

    auto* side = new QWidget;
    auto* buttons = new QHBoxLayout;
    buttons->setSpacing(4);
    buttons->addWidget(add);
    buttons->addStretch(1);
    buttons->addWidget(rescan);
    buttons->addWidget(m_removeFolder);
    auto* column = new QVBoxLayout(side);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(tokens::kGap / 2);
    column->addLayout(buttons);
    column->addWidget(m_folders, 1);
    column->addWidget(m_unreadableToggle);
    column->addWidget(m_unreadable);
    column->addWidget(m_progress);

    connect(add, &QToolButton::clicked, this, &LibraryPanel::browse);
    connect(rescan, &QToolButton::clicked, &m_library, &EnvironmentLibrary::rescan);
    connect(m_removeFolder, &QToolButton::clicked, this, [this] {
        if (const QListWidgetItem* item = m_folders->currentItem())
            m_library.removeFolder(item->data(kPathRole).toString());
    });
    connect(m_folders, &QListWidget::currentItemChanged, this, [this](const QListWidgetItem* item) {
        m_removeFolder->setEnabled(item && !item->data(kPathRole).toString().isEmpty());
    });
    connect(m_folders, &QListWidget::itemChanged, this, [this](const QListWidgetItem* item) {
        m_library.setFolderShown(item->data(kPathRole).toString(),
                                 item->checkState() == Qt::Checked);
    });
    connect(m_unreadableToggle, &QToolButton::toggled, m_unreadable, &QWidget::setVisible);
    return side;
}

QWidget* LibraryPanel::makeQuery() {
    const EnvironmentLibrary::Query& query = m_library.query();
    m_search->setPlaceholderText(tr("Search names and tags"));
    m_search->setClearButtonEnabled(true);
    m_search->setAccessibleName(tr("Search the library"));
    m_search->setToolTip(tr("Words of names, and tags such as sun, soft, warm or dark; all of them "
                            "must fit"));
    m_search->setStatusTip(m_search->toolTip());
    for (QToolButton* clear : m_search->findChildren<QToolButton*>()) {
        clear->setAccessibleName(tr("Clear the search"));
        clear->setToolTip(tr("Show all environments again"));
        clear->setStatusTip(clear->toolTip());
    }
    m_sort->setAccessibleName(tr("Sort by"));
    m_sort->setToolTip(tr("What the environments are sorted by"));
    m_sort->setStatusTip(m_sort->toolTip());
    for (int i = 0; i < kCatalogSorts; ++i) {
        m_sort->addItem(toQString(sortLabel(static_cast<CatalogSort>(i))));
        m_sort->setItemData(i,
                            tr("Sorted %1").arg(toQString(sortHelp(static_cast<CatalogSort>(i)))),
                            Qt::ToolTipRole);
    }
    m_sort->setCurrentIndex(static_cast<int>(query.sort));
    m_descending->setChecked(query.descending);
    m_favourites->setChecked(query.favouritesOnly);
    auto* row = new QWidget;
    auto* layout = new QHBoxLayout(row);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(4);
    layout->addWidget(m_search, 1);
    layout->addWidget(m_favourites);
    layout->addSpacing(tokens::kGap);
    layout->addWidget(m_sort);
    layout->addWidget(m_descending);
    connect(m_search, &QLineEdit::textChanged, this, &LibraryPanel::ask);
    connect(m_sort, &QComboBox::currentIndexChanged, this, &LibraryPanel::ask);
    for (const QToolButton* toggle : {m_favourites, m_descending})
        connect(toggle, &QToolButton::toggled, this, &LibraryPanel::ask);
    return row;
}

void LibraryPanel::ask() {
    m_asking = true;
    m_library.setQuery({m_search->text(), m_favourites->isChecked(),
                        static_cast<CatalogSort>(m_sort->currentIndex()),
                        m_descending->isChecked()});
    m_asking = false;
}

void LibraryPanel::browse() {
    const QString before = QSettings().value(QLatin1String(kLibraryFolderKey)).toString();
    auto* dialog = new QFileDialog(this, tr("Add Folder to the Library"),
                                   QFileInfo::exists(before) ? before : QDir::homePath());
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::Directory);
    dialog->setOption(QFileDialog::ShowDirsOnly);
    connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& folder) {
        QSettings().setValue(QLatin1String(kLibraryFolderKey), folder);
        m_library.addFolder(folder);
    });
    dialog->open();
}

// --- What is shown -------------------------------------------------------------------------------

void LibraryPanel::refreshFolders() {
    const QSignalBlocker silent(m_folders);
    const QListWidgetItem* before = m_folders->currentItem();
    const QString current = before ? before->data(kPathRole).toString() : QString();
    m_folders->clear();
    for (const LibraryFolder& folder : m_library.folders()) {
        const bool builtin = folder.path.isEmpty();
        const QString name = builtin ? tr("Built-in skies") : QDir(folder.path).dirName();
        auto* item = new QListWidgetItem(
            folder.found > 0 ? tr("%1 (%2)").arg(name).arg(folder.found) : name, m_folders);
        item->setData(kPathRole, folder.path);
        item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
        item->setCheckState(folder.shown ? Qt::Checked : Qt::Unchecked);
        const QString place = builtin ? tr("The skies that Patina makes itself") : folder.path;
        item->setToolTip(
            folder.problem.isEmpty() ? place : QStringLiteral("%1\n%2").arg(place, folder.problem));
        item->setStatusTip(item->toolTip().replace(QLatin1Char('\n'), QLatin1String(": ")));
        if (!folder.problem.isEmpty())
            item->setIcon(icon(QStringLiteral("warning"), tokens::kCopper));
        if (folder.path == current)
            m_folders->setCurrentItem(item);
    }
    const QListWidgetItem* now = m_folders->currentItem();
    m_removeFolder->setEnabled(now && !now->data(kPathRole).toString().isEmpty());
    refreshItems();
}

void LibraryPanel::refreshItems() {
    const std::vector<const LibraryItem*> unreadable = m_library.unreadable();
    m_unreadableToggle->setVisible(!unreadable.empty());
    m_unreadableToggle->setText(unreadable.size() == 1
                                    ? tr("1 file cannot be read")
                                    : tr("%1 files cannot be read").arg(unreadable.size()));
    m_unreadableToggle->setAccessibleName(m_unreadableToggle->text());
    m_unreadable->setVisible(!unreadable.empty() && m_unreadableToggle->isChecked());
    m_unreadable->clear();
    for (const LibraryItem* each : unreadable) {
        auto* item = new QListWidgetItem(
            tr("%1: %2").arg(shownFileName(each->source), each->problem), m_unreadable);
        item->setToolTip(each->source);
        item->setStatusTip(each->source);
    }
    const int left = m_library.leftToMeasure();
    const auto all = static_cast<int>(m_library.items().size());
    m_progress->setVisible(m_library.isListing() || left > 0);
    m_progress->setText(left > 0 ? tr("Measured %1 of %2").arg(all - left).arg(all)
                                 : tr("Looking for files…"));
    const bool filtered = !m_search->text().trimmed().isEmpty() || m_favourites->isChecked();
    m_view->setEmptyText(m_library.items().empty() ? tr("Looking for files…")
                         : filtered                ? tr("No environment fits the search")
                                    : tr("Tick a folder, or drop one with HDR or EXR files here"));
    refreshDetails();
}

void LibraryPanel::refreshDetails() {
    const LibraryItem* item = m_library.item(m_view->currentSource());
    const LibrarySummary summary =
        item ? summaryOf(*item)
             : LibrarySummary{tr("Choose an environment to see what was measured of it."),
                              tr("Drop a folder of HDR or EXR files here to add it.")};
    m_name->setText(summary.name);
    m_measures->setText(summary.measures);
    for (QLabel* line : {m_name, m_measures})
        line->setToolTip(item ? toolTipText(*item) : line->statusTip());
}

void LibraryPanel::openMenu(const QString& source, const QPoint& globalPosition) {
    auto* menu = new QMenu(this);
    menu->setAttribute(Qt::WA_DeleteOnClose);
    menu->setObjectName(QStringLiteral("libraryMenu"));
    const auto add = [&](const QString& text, const QString& help, auto work) {
        QAction* action = menu->addAction(text, this, work);
        Actions::describe(action, help);
        return action;
    };
    if (!source.isEmpty()) {
        add(tr("&Use"), tr("Light the scene with this environment (Enter)"),
            [this, source] { m_library.use(source); });
        add(tr("&Add as Another Environment"),
            tr("Add it to the scene's environments and light the scene with it"),
            [this, source] { m_library.addToScene(source); });
        const bool favourite = m_library.isFavourite(source);
        add(favourite ? tr("No &Favourite") : tr("&Favourite"),
            favourite ? tr("Take the star away") : tr("Mark it with a star, to find it again"),
            [this, source, favourite] { m_library.setFavourite(source, !favourite); });
        if (!source.startsWith(QLatin1String("builtin:")))
            add(tr("&Copy Path"), tr("Put the path of the file on the clipboard"),
                [source] { QGuiApplication::clipboard()->setText(source); });
        menu->addSeparator();
    }
    QAction* previews =
        add(tr("&Preview on Hover"),
            tr("Show the environment that the pointer rests on in the picture, or in the current "
               "cell of the wall, until it leaves"),
            [this] { m_preview.setWanted(!m_preview.isWanted()); });
    previews->setCheckable(true);
    previews->setChecked(m_preview.isWanted());
    menu->popup(globalPosition);
}

// --- Events --------------------------------------------------------------------------------------

void LibraryPanel::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    m_library.load();
}

// The folders beside the grid, or above it where the dock is upright.
void LibraryPanel::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    const bool wide = width() > kWideFrom;
    m_layout->setDirection(wide ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
    m_side->setMinimumWidth(wide ? kSideWidth : 0);
    m_side->setMaximumWidth(wide ? kSideWidth : QWIDGETSIZE_MAX);
    m_side->setMaximumHeight(wide ? QWIDGETSIZE_MAX : kSideHeight);
}

void LibraryPanel::dragEnterEvent(QDragEnterEvent* event) {
    if (!foldersOf(*event->mimeData()).isEmpty()) // the window takes files
        event->acceptProposedAction();
    else
        event->ignore();
}

void LibraryPanel::dropEvent(QDropEvent* event) {
    event->acceptProposedAction();
    for (const QString& folder : foldersOf(*event->mimeData()))
        m_library.addFolder(folder);
}

void connectLibrary(EnvironmentLibrary& library, const Actions& actions, FileFlow& files,
                    QWidget& viewport) {
    viewport.addActions({actions.nextEnvironment, actions.previousEnvironment});
    QObject::connect(actions.nextEnvironment, &QAction::triggered, &library,
                     [&library] { library.step(1); });
    QObject::connect(actions.previousEnvironment, &QAction::triggered, &library,
                     [&library] { library.step(-1); });
    QObject::connect(&files, &FileFlow::folderAdded, actions.library, [&actions] {
        if (!actions.library->isChecked())
            actions.library->trigger();
    });
}

} // namespace patina::editor
