// The Lighting Ladder dock: the scene lit by every method beside each other, with its error against
// the path-traced picture and its cost; any two on the sides of a line.
#pragma once

#include "app/editor/ladder/LadderWork.h"

#include <QTimer>
#include <QWidget>
#include <cstddef>

class QCheckBox;
class QComboBox;
class QLabel;
class QPushButton;
class QStackedWidget;
class QTableView;

namespace patina {
struct Change;
}

namespace patina::editor {

class LadderModel;
class LadderPicture;
struct Session;

class LadderPanel : public QWidget {
    Q_OBJECT
  public:
    // `viewport`: whose proportions the pictures have.
    LadderPanel(Session& session, const QWidget& viewport, QWidget* parent = nullptr);

    void start(); // of the document as it is
    void cancel();
    void useSelected(); // lights the scene by it
    void useClosest();

    [[nodiscard]] const LadderShownPtr& shown() const { return m_shown; } // null: nothing yet
    [[nodiscard]] bool isRunning() const { return m_job != 0; }
    [[nodiscard]] bool isOfEarlierState() const { return m_stale; }
    void select(std::size_t step);
    [[nodiscard]] QTableView& table() { return *m_table; }
    [[nodiscard]] LadderPicture& picture() { return *m_picture; }
    [[nodiscard]] QString status() const;
    [[nodiscard]] QSize sizeHint() const override { return {960, 340}; }
    [[nodiscard]] QSize minimumSizeHint() const override { return {300, 160}; }

  Q_SIGNALS:
    void pathTracingWanted();

  protected:
    void showEvent(QShowEvent* event) override;

  private:
    enum class Look { Picture, Exposure, Visible };

    [[nodiscard]] QWidget* makeControls();
    [[nodiscard]] QWidget* makeResult();
    void follow(const Change& change);
    void take(const LadderShownPtr& shown);
    void jobsChanged();
    void ended();
    void showProgress();
    void refresh(); // texts and pages
    void refreshPicture();
    void refreshClosest();
    void use(const LadderStep& step);
    void fillOthers();
    void checkState();
    [[nodiscard]] const LadderStep* selected() const; // null: none

    Session& m_session;
    const QWidget& m_viewport;
    LadderShownPtr m_shown;
    std::shared_ptr<const KeptLadderBakes> m_kept;
    quint64 m_job = 0;   // 0: none runs
    quint64 m_round = 0; // of the newest one
    bool m_stale = false;
    QString m_ended; // how the last one ended without a result

    QPushButton *m_start, *m_use, *m_useClosest;
    QCheckBox* m_live;
    QComboBox *m_look, *m_other;
    QLabel *m_status, *m_warning, *m_empty;
    QStackedWidget* m_pages;
    LadderModel* m_model;
    QTableView* m_table;
    LadderPicture* m_picture;
    QTimer m_progress; // while one runs
    QTimer m_rest;     // since the last edit
};

} // namespace patina::editor
