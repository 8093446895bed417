// Gives freed memory back to the system when the editor comes to rest. Frames and background work
// free much in small blocks (shader compilers most of all: hundreds of MiB in the first minutes on
// a software driver), which the C library keeps for itself otherwise.
#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QThreadPool>
#include <QTimer>

namespace patina::editor {

class FreedMemory : public QObject {
    Q_OBJECT
  public:
    explicit FreedMemory(QObject* parent = nullptr);

    // A frame was drawn: the editor rests once none follows for kRestMs.
    void frameDrawn();

    static constexpr int kRestMs = 1500;
    static constexpr int kPauseMs = 15'000; // between two times that it is given back

  Q_SIGNALS:
    void returned();

  private:
    void giveBack();

    QTimer m_rest;
    QElapsedTimer m_last;
    QThreadPool m_pool; // its destructor waits
};

} // namespace patina::editor
