// The Light sweep dock: the light in which the material fails, found among environments and their
// rotations, with pictures of it, and taken over into the scene.
#pragma once

#include "app/editor/sweep/SweepWork.h"

#include <QTimer>
#include <QWidget>
#include <optional>

class QLabel;
class QListWidget;
class QPushButton;
class QSortFilterProxyModel;
class QStackedWidget;
class QTableView;

namespace patina::editor {

class ColorScale;
class DocumentController;
class JobManager;
class SweepControls;
class SweepModel;
class SweepPicture;
class SweepStrip;

class LightSweepPanel : public QWidget {
    Q_OBJECT
  public:
    // `viewport`: whose proportions the pictures have.
    LightSweepPanel(DocumentController& controller, JobManager& jobs, const QWidget& viewport,
                    QWidget* parent = nullptr);

    void start(); // of the document as it is, by the settings as they are
    void cancel();
    void useSelected(); // lights the scene with it
    void saveOutcome(); // asks for the file

    [[nodiscard]] const SweepOutcomePtr& outcome() const { return m_outcome; } // null: none yet
    [[nodiscard]] bool isRunning() const { return m_job != 0; }
    [[nodiscard]] bool isOfEarlierState() const { return m_stale; }
    // The light that is looked at: an index into LightSweep::scores.
    [[nodiscard]] std::optional<std::size_t> selected() const { return m_selected; }
    void select(std::size_t light);
    [[nodiscard]] SweepControls& controls() { return *m_controls; }
    [[nodiscard]] QTableView& table() { return *m_table; }
    [[nodiscard]] SweepStrip& strip() { return *m_strip; }
    [[nodiscard]] QListWidget& problems() { return *m_problems; }
    [[nodiscard]] SweepPicture& lightPicture() { return *m_light; }
    [[nodiscard]] SweepPicture& referencePicture() { return *m_reference; }
    [[nodiscard]] SweepPicture& sensitivityPicture() { return *m_sensitivity; }
    [[nodiscard]] QString status() const; // what is said above the result
    [[nodiscard]] QString warning() const;
    [[nodiscard]] QSize sizeHint() const override { return {960, 340}; }
    [[nodiscard]] QSize minimumSizeHint() const override { return {300, 160}; }

  protected:
    void showEvent(QShowEvent* event) override;

  private:
    [[nodiscard]] QWidget* makeResult();
    [[nodiscard]] QWidget* makeLights();
    [[nodiscard]] QWidget* makePictures();
    void take(const SweepOutcomePtr& outcome);
    void jobsChanged();
    void ended(); // the job is followed no more
    [[nodiscard]] QString cancelledText() const;
    void showProgress();
    void rank();
    void refresh(); // texts and pages
    void refreshPictures();
    void showSensitivity(double from, double to);
    void checkState(); // whether the result is of an earlier state of the document

    DocumentController& m_controller;
    JobManager& m_jobs;
    const QWidget& m_viewport;
    SweepOutcomePtr m_outcome;
    std::optional<std::size_t> m_selected;
    quint64 m_job = 0; // 0: none runs
    bool m_stale = false, m_refreshing = false;
    QString m_ended; // how the last sweep ended without a result

    SweepControls* m_controls;
    QLabel *m_status, *m_warning, *m_empty, *m_stripTitle, *m_range;
    QPushButton *m_again, *m_use, *m_save;
    QStackedWidget* m_pages;
    SweepModel* m_model;
    QSortFilterProxyModel* m_sorted;
    QTableView* m_table;
    QListWidget* m_problems;
    SweepPicture *m_light, *m_reference, *m_sensitivity;
    ColorScale* m_scale;
    SweepStrip* m_strip;
    QTimer m_progress; // while one runs
};

} // namespace patina::editor
