// SIGTERM, SIGHUP and SIGINT as a Qt signal: the system or the user's terminal ends the editor. A
// second one ends it at once.
#pragma once

#include "core/base/FileDescriptor.h"

#include <QObject>

namespace patina::editor {

class TerminationSignals : public QObject {
    Q_OBJECT
  public:
    // One for the process. Signals that it was started to ignore (nohup) stay ignored.
    explicit TerminationSignals(QObject* parent = nullptr);
    ~TerminationSignals() override; // they end the process again

  Q_SIGNALS:
    void received(int signal); // on this object's thread

  private:
    FileDescriptor m_read, m_write;
};

} // namespace patina::editor
