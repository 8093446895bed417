// A number that is scrubbed by dragging, typed, stepped with the wheel or the arrow keys.
// Shift is fine, Ctrl is coarse, Esc goes back to where it was. Sums may be typed ("1/3"). What is
// typed counts with Enter, when the focus goes, with a click elsewhere and with a shortcut.
#pragma once

#include "app/editor/widget/EditControl.h"

#include <QLineEdit>
#include <functional>
#include <optional>

namespace patina::editor {

struct NumberFormat {
    double softMin = 0, softMax = 1; // what a drag of a few hundred pixels spans
    double hardMin = 0, hardMax = 1;
    int decimals = 3;
    bool wraps = false; // leaving one end enters at the other
    QString unit;
    std::function<QString(double)> name = {}; // shown instead of a number where it is not empty
};

class NumberField : public QLineEdit, public EditControl {
    Q_OBJECT
  public:
    explicit NumberField(const NumberFormat& format, QWidget* parent = nullptr);

    // Shows `value` and emits nothing. While the user types, the text stays.
    void setValue(double value);
    [[nodiscard]] double value() const { return m_value; }
    void setUnit(const QString& unit); // with the space before it: " cd"
    void setFormat(const NumberFormat& format);
    [[nodiscard]] bool isEditing() const { return m_mode == Mode::Editing; }

    void abandonEdit() override;

    // "0.5", "0,5", "45°", "1/3 EV": nothing when it is no finite number.
    [[nodiscard]] static std::optional<double> parse(const QString& text, const QString& unit);
    [[nodiscard]] static QString format(double value, int decimals);

  Q_SIGNALS:
    void dragStarted();
    void dragged(double value);
    void dragFinished();
    void stepped(double value); // wheel and arrow keys
    void edited(double value);  // typed

  protected:
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool event(QEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    enum class Mode { Idle, Pressed, Scrubbing, Editing };
    void beginEditing();
    void endEditing(bool accept);
    void leaveEditing();
    // Enter: text that is no number stays, marked, to be corrected.
    void enter();
    void markRefused(bool refused);
    void finishScrub();
    void scrubBy(int pixels, Qt::KeyboardModifiers modifiers);
    void step(double steps, Qt::KeyboardModifiers modifiers);
    void showValue();
    [[nodiscard]] double bounded(double value) const; // rounded to the decimals, inside the range

    NumberFormat m_format;
    double m_value = 0;
    Mode m_mode = Mode::Idle;
    bool m_refused = false; // the text is marked as no number
    double m_scrubStart = 0;
    int m_lastX = 0;
    qint64 m_scrubOffset = 0; // in tenths of a pixel, so that going back ends where it began
};

} // namespace patina::editor
