// The Transfer dock: how light comes to the pinned point, or the one under the pointer, by the
// attached bake: as a lobe on the surface, as coefficients, and against the environment.
#pragma once

#include "app/editor/job/LatestJob.h"
#include "app/editor/panel/TransferPictures.h"

#include <QWidget>
#include <optional>

class QComboBox;
class QLabel;
class QPushButton;
class QStackedWidget;

namespace patina::editor {

class BandBars;
class DocumentController;
class LobeOnSurface;
class NearShadowUpdater;
class PictureTile;
class PixelProbe;

class TransferPanel : public QWidget {
    Q_OBJECT
  public:
    TransferPanel(DocumentController& controller, PixelProbe& probe, LobeOnSurface& onSurface,
                  const NearShadowUpdater& shadows, QWidget* parent = nullptr);
    ~TransferPanel() override;

    // Null: nothing to show, message() says why.
    [[nodiscard]] std::shared_ptr<const TransferPictures> pictures() const { return m_shown; }
    [[nodiscard]] QString message() const;
    [[nodiscard]] bool upToDate() const { return !m_job.busy(); }
    [[nodiscard]] QSize sizeHint() const override { return {780, 280}; }
    [[nodiscard]] QSize minimumSizeHint() const override { return {240, 160}; }

  Q_SIGNALS:
    void bakeWanted(); // there is none to look at

  protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;

  private:
    void refresh(); // requests new pictures, when someone sees it
    [[nodiscard]] std::optional<TransferPicturesRequest> request(QString& problem) const;
    void show(std::shared_ptr<const TransferPictures> pictures, const QString& problem);

    DocumentController& m_controller;
    PixelProbe& m_probe;
    LobeOnSurface& m_onSurface;
    const NearShadowUpdater& m_shadows;
    std::optional<TransferPicturesRequest> m_requested;
    std::shared_ptr<const TransferPictures> m_shown;
    std::shared_ptr<TransferPicturesMemory> m_memory; // the pool's thread alone uses it

    QStackedWidget* m_pages;
    QLabel *m_message, *m_numbers;
    QPushButton* m_bake; // under the message, where a bake is what is missing
    QComboBox* m_lightBands;
    BandBars* m_bars;
    PictureTile *m_seen, *m_function, *m_sum;
    LatestJob m_job; // last: it ends first
};

} // namespace patina::editor
