// What the TerminationWatch hears, as a Qt signal.
#pragma once

#include <QObject>
#include <functional>

namespace patina::editor {

class TerminationWatch;

class TerminationSignals : public QObject {
    Q_OBJECT
  public:
    // The watch lives longer. `atLast`: see there; on its thread.
    TerminationSignals(TerminationWatch& watch, std::function<void()> atLast,
                       QObject* parent = nullptr);
    ~TerminationSignals() override;

  Q_SIGNALS:
    void received(int signal); // on this object's thread

  private:
    TerminationWatch& m_watch;
};

} // namespace patina::editor
