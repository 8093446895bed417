// What the user is asked before a save does something that cannot be taken back.
#pragma once

#include <QString>
#include <functional>

namespace patina::editor {

// What the user has agreed to.
struct SaveConsent {
    bool overwriteChanged = false;  // others changed the file
    bool overwriteReadOnly = false; // the file is write-protected
    bool overwriteOpen = false;     // it is open in another editor; holds as long as it is there
};

// Who answers calls one of the two functions, or neither and saves in another place with `done`.
struct SaveQuestion {
    enum class Reason { FolderGone, Changed, ReadOnly, OpenElsewhere };
    Reason reason = Reason::Changed;
    QString file;                    // absolute
    QString text;                    // the reason, as a sentence
    std::function<void()> overwrite; // saves all the same; not for FolderGone
    std::function<void(bool)> done;  // of the save: false to give it up
};

} // namespace patina::editor
