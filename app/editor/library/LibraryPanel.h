// The Library dock: folders of environments, a grid of them with search, order and favourites, what
// was measured of the one that is chosen, and the files that cannot be read.
#pragma once

#include <QWidget>

class QAction;
class QBoxLayout;
class QComboBox;
class QLabel;
class QLineEdit;
class QListWidget;
class QListWidgetItem;
class QToolButton;

namespace patina::editor {

class Actions;
class EnvironmentLibrary;
class EnvironmentPreview;
class FileFlow;
class LibraryModel;
class LibraryView;

class LibraryPanel : public QWidget {
    Q_OBJECT
  public:
    LibraryPanel(EnvironmentLibrary& library, EnvironmentPreview& preview,
                 QWidget* parent = nullptr);

    [[nodiscard]] LibraryView& view() { return *m_view; }
    [[nodiscard]] QListWidget& folders() { return *m_folders; }

  protected:
    void showEvent(QShowEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;

  private:
    [[nodiscard]] QWidget* makeFolders();
    [[nodiscard]] QWidget* makeQuery();
    void browse();
    void ask(); // what is shown, as the controls say
    void refreshFolders();
    void refreshItems();
    void refreshDetails();
    void openMenu(const QString& source, const QPoint& globalPosition);

    EnvironmentLibrary& m_library;
    EnvironmentPreview& m_preview;
    LibraryModel* m_model;
    QListWidget *m_folders, *m_unreadable;
    QToolButton *m_removeFolder, *m_unreadableToggle;
    QLabel* m_progress;
    QLineEdit* m_search;
    QToolButton *m_favourites, *m_descending;
    QComboBox* m_sort;
    LibraryView* m_view;
    QLabel *m_name, *m_measures; // of the one that is chosen
    QWidget* m_side;
    QBoxLayout* m_layout;
    QString m_chosen; // kept while the grid is laid out anew
    bool m_refreshing = false;
    bool m_asking = false; // for another order or selection
    int m_scrolled = 0;    // while the grid is laid out anew
};

// Page Up and Page Down in the viewport step through the library, and the dock opens where a folder
// was dropped on the window.
void connectLibrary(EnvironmentLibrary& library, const Actions& actions, FileFlow& files,
                    QWidget& viewport);

} // namespace patina::editor
