// The settings of a sweep of lights, and the button that starts or cancels it.
#pragma once

#include "core/rank/LightSweep.h"

#include <QString>
#include <QWidget>

class QCheckBox;
class QComboBox;
class QPushButton;
class QSpinBox;

namespace patina::editor {

class DocumentController;
struct SweepOrder;

class SweepControls : public QWidget {
    Q_OBJECT
  public:
    explicit SweepControls(DocumentController& controller, QWidget* parent = nullptr);

    void fill(SweepOrder& order) const; // what is chosen
    [[nodiscard]] RankBy by() const;
    void setFolder(const QString& folder); // and that it is swept; remembered
    void setRunning(bool running);
    void add(QWidget* more); // behind the rest

  Q_SIGNALS:
    void startWanted();
    void cancelWanted();
    void byChanged();

  private:
    void browse();
    void showFolder();
    void refresh();

    DocumentController& m_controller;
    QString m_folder;
    QCheckBox *m_ofDocument, *m_shipped, *m_ofFolder;
    QSpinBox* m_rotations;
    QComboBox *m_by, *m_reference;
    QPushButton* m_start;
    bool m_running = false;
};

} // namespace patina::editor
