// Prepares image-based light in the background: a small version at once, the full one when it is
// ready. The newest environment wins.
#pragma once

#include "core/image/Image.h"
#include "core/job/JobContext.h"
#include "core/light/Ibl.h"

#include <QObject>
#include <QThreadPool>
#include <memory>

namespace patina::editor {

class IblUpdater : public QObject {
    Q_OBJECT
  public:
    explicit IblUpdater(QObject* parent = nullptr);
    ~IblUpdater() override; // cancels and waits

    // Does nothing when `environment` is the one already prepared or under way. Requests that
    // follow each other quickly wait for the small version of the first, so that light keeps
    // coming while something is dragged.
    void request(ImagePtr environment);
    // The last result, so that a new OpenGL context can be given it again; null before the first.
    [[nodiscard]] std::shared_ptr<const IblMaps> maps() const { return m_maps; }

  Q_SIGNALS:
    void ready(); // maps() is new

  private:
    void start();
    void deliver(quint64 request, bool quick, std::shared_ptr<const IblMaps> maps);

    QThreadPool m_pool;
    JobControl m_control;
    ImagePtr m_environment;
    quint64 m_request = 0;
    bool m_quickUnderWay = false, m_waiting = false;
    std::shared_ptr<const IblMaps> m_maps;
};

} // namespace patina::editor
