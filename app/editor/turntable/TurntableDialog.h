// Asks how a turntable or a turning light is to be saved: what turns, how many pictures of which
// size, and the file.
#pragma once

#include "app/editor/turntable/TurntableSave.h"

#include <QDialog>

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QSpinBox;

namespace patina::editor {

class OutputFile;
class ViewportWidget;

class TurntableDialog : public QDialog {
    Q_OBJECT
  public:
    TurntableDialog(Session& session, const ViewportWidget& viewport, QWidget* parent = nullptr);

    // Shows one, which deletes itself when it is closed.
    static void open(Session& session, const ViewportWidget& viewport, QWidget* parent);
    using QDialog::open;

  private:
    QWidget* makeSettings();
    QWidget* makeCounts();
    QWidget* makeSize();
    void followLength(); // pictures, by the seconds asked for
    void showLength();   // of so many pictures
    void followPreset(); // width and height
    void showPreset();   // that they are, or "Custom"
    void refresh();      // shows what will be written, or why not
    void run();
    [[nodiscard]] TurntableOrder order() const;

    Session& m_session;
    const ViewportWidget& m_viewport;
    OutputFile* m_output;
    QString m_noVideo; // why no video can be written; empty: it can
    QComboBox *m_turning = nullptr, *m_preset = nullptr, *m_samples = nullptr;
    QSpinBox *m_count = nullptr, *m_rate = nullptr, *m_width = nullptr, *m_height = nullptr;
    QDoubleSpinBox* m_length = nullptr;
    QLabel *m_note = nullptr, *m_summary = nullptr;
};

} // namespace patina::editor
