// Prepares an environment in the background, as the viewport's textures take it: its light from the
// cache, or else a small version within some ten milliseconds and the full one when it is ready.
// The newest environment wins.
#pragma once

#include "core/image/Image.h"
#include "core/job/JobContext.h"
#include "core/light/EnvironmentTexels.h"
#include "core/light/IblCache.h"

#include <QObject>
#include <QThreadPool>
#include <atomic>
#include <filesystem>
#include <utility>

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
    // The last result, once: it is large. Null when there is none, or it has been taken.
    [[nodiscard]] EnvironmentTexelsPtr take() { return std::exchange(m_texels, nullptr); }
    // What it was made of, for whoever else shows it; null before the first.
    [[nodiscard]] std::shared_ptr<const IblMaps> maps() const { return m_maps; }
    // maps() are of the environment asked for last, at full resolution: nothing else is to come.
    [[nodiscard]] bool finished() const { return m_finished; }
    // What has been taken is lost and needed again, by a new OpenGL context.
    void renew();

  Q_SIGNALS:
    void ready(); // take() has something, and maps() is of the same

  private:
    void start();
    void prepare(quint64 request, const ImagePtr& environment, const JobContext& job);
    void refine(quint64 request, const Hash& key, const ImagePtr& environment,
                const HalfMipmapsPtr& background, const JobContext& job);
    void fail(quint64 request, const Error& error);
    // From the pool to deliver(); null where there is no light. `last`: nothing follows.
    void post(quint64 request, EnvironmentTexelsPtr texels, std::shared_ptr<const IblMaps> maps,
              bool last);
    void deliver(quint64 request, EnvironmentTexelsPtr texels, std::shared_ptr<const IblMaps> maps,
                 bool last);

    IblCache m_cache;
    QThreadPool m_pool, m_finePool; // first light in no time; full light when nobody is in a hurry
    JobControl m_control;
    ImagePtr m_environment;
    std::atomic<quint64> m_request = 0; // the newest
    bool m_firstUnderWay = false, m_waiting = false, m_finished = false;
    EnvironmentTexelsPtr m_texels; // until it is taken
    std::shared_ptr<const IblMaps> m_maps;
};

} // namespace patina::editor
