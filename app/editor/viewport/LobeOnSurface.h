// The lobe that stands on the surface in the viewport: at the pinned point, else where the pointer
// is. Kept in step with the point, the material and the camera, off the UI thread.
#pragma once

#include "app/editor/job/LatestJob.h"
#include "core/light/LensCurves.h"
#include "render/scene/SurfaceLobe.h"
#include "render/view/Inspection.h"

#include <QObject>
#include <QString>
#include <memory>
#include <optional>

namespace patina::editor {

class DocumentController;
class PixelProbe;

class LobeOnSurface : public QObject {
    Q_OBJECT
  public:
    LobeOnSurface(DocumentController& controller, PixelProbe& probe, QObject* parent = nullptr);
    ~LobeOnSurface() override;

    // Nothing: no lobe. 0: which light the viewer sees there; else what becomes of that light's.
    void show(std::optional<Id> light);
    void setScale(const LobeScale& scale);
    // Another instrument's lobe, shown in place of this one until it is null again.
    void setOther(std::shared_ptr<const render::SurfaceLobe> lobe);

    [[nodiscard]] std::shared_ptr<const render::SurfaceLobe> lobe() const {
        return m_other ? m_other : m_lobe;
    }
    // Why there is no lobe although one is wanted; empty when there is.
    [[nodiscard]] QString problem() const { return m_problem; }
    [[nodiscard]] bool upToDate() const { return !m_job.busy(); }

  Q_SIGNALS:
    void changed();

  private:
    // All that a lobe is made of.
    struct Ask {
        glm::vec3 position, tangent, bitangent, normal, toFixed; // world
        LobeEnd end = LobeEnd::Viewer;
        LensLook look;
        LobeScale scale;
        friend bool operator==(const Ask&, const Ask&) = default;
    };
    void refresh();
    [[nodiscard]] std::optional<Ask> ask(QString& problem) const;
    void set(std::shared_ptr<const render::SurfaceLobe> lobe, const QString& problem);

    DocumentController& m_controller;
    PixelProbe& m_probe;
    std::optional<Id> m_light;
    LobeScale m_scale;
    std::optional<Ask> m_asked;
    std::shared_ptr<const render::SurfaceLobe> m_lobe, m_other;
    QString m_problem;
    std::shared_ptr<DfgTables> m_tables; // the pool's thread alone uses it
    LatestJob m_job;                     // last: it ends first
};

} // namespace patina::editor
