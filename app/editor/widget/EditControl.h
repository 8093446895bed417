// Ends edits where what a control shows is about to change or to go: nothing that is taken down
// reports an edit, and nothing that was typed for one element reaches another.
#pragma once

#include <QtGlobal>

class QLayout;
class QWidget;

namespace patina::editor {

// A control in which an edit takes time: text that is being typed, a handle that is being dragged.
class EditControl {
  public:
    virtual ~EditControl() = default;
    // Ends the edit without a signal. The control shows the value set last.
    virtual void abandonEdit() = 0;

  protected:
    EditControl() = default;
    EditControl(const EditControl&) = default;
    EditControl& operator=(const EditControl&) = default;
};

// Steps of one control (the wheel, keys) with a longer pause between them are steps of the history.
inline constexpr qint64 kStepPauseMs = 700;

// Ends every edit in `root` and below without a signal, and closes what popped up from there.
// For controls that are kept and are about to show something else, or to be hidden or disabled.
void abandonEdits(QWidget& root);

// Takes `widget` out of the window for good: it is silent and hidden at once, and deleted by the
// event loop, because it may be what was clicked. Its parent gets the keyboard, if it takes it.
void retire(QWidget* widget);

// The same for every widget of `layout`, which is empty afterwards.
void retireAll(QLayout& layout);

} // namespace patina::editor
