// Prepares image-based light in the background: from the cache, or else a small version within
// some ten milliseconds and the full one when it is ready. The newest environment wins.
#pragma once

#include "core/image/Image.h"
#include "core/job/JobContext.h"
#include "core/light/IblCache.h"

#include <QObject>
#include <QThreadPool>
#include <atomic>
#include <filesystem>
#include <memory>

namespace patina::editor {

class IblUpdater : public QObject {
    Q_OBJECT
  public:
    // `cacheFolder`: of IblCache.
    explicit IblUpdater(const std::filesystem::path& cacheFolder, QObject* parent = nullptr);
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
    void prepare(quint64 request, const Image& environment, const JobContext& job);
    void post(quint64 request, std::shared_ptr<const IblMaps> maps); // from the pool to deliver()
    void deliver(quint64 request, std::shared_ptr<const IblMaps> maps);

    IblCache m_cache;
    QThreadPool m_pool;
    JobControl m_control;
    ImagePtr m_environment;
    std::atomic<quint64> m_request = 0; // the newest
    bool m_firstUnderWay = false, m_waiting = false;
    std::shared_ptr<const IblMaps> m_maps;
};

} // namespace patina::editor
