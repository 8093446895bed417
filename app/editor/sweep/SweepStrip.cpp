#include "app/editor/sweep/SweepStrip.h"

#include "app/editor/document/QtText.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/sweep/SweepModel.h"
#include "app/editor/sweep/SweepPicture.h"

#include <QScrollBar>
#include <utility>

namespace patina::editor {
namespace {

constexpr int kStripHeight = 44; // of its pictures
constexpr int kStripWidest = 88;

QIcon stripIcon(const QImage& thumb, qreal ratio) {
    QPixmap pixmap = QPixmap::fromImage(thumb);
    pixmap.setDevicePixelRatio(ratio);
    QIcon icon(pixmap);
    icon.addPixmap(pixmap, QIcon::Selected); // without the tint of the selection
    return icon;
}

} // namespace

SweepStrip::SweepStrip(TaskRunner& runner, QWidget* parent)
    : QListWidget(parent)
    , m_job(runner, "pictures of a light sweep", this, TaskPriority::High) {
    setAccessibleName(tr("Rotations of the environment"));
    setToolTip(tr("The environment in all its rotations; choose one to look at it"));
    setStatusTip(toolTip());
    setViewMode(QListView::IconMode);
    setFlow(QListView::LeftToRight);
    setWrapping(false);
    setMovement(QListView::Static);
    setUniformItemSizes(true);
    setSpacing(1);
    setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    setSelectionMode(QAbstractItemView::SingleSelection);
    setFixedHeight(kStripHeight + fontMetrics().height() +
                   horizontalScrollBar()->sizeHint().height() + 2 * tokens::kGap);
    connect(this, &QListWidget::currentRowChanged, this, [this](int row) {
        if (!m_refreshing && row >= 0)
            Q_EMIT chosen(m_environment * m_outcome->rotations() + static_cast<std::size_t>(row));
    });
}

void SweepStrip::show(const SweepOutcomePtr& outcome, std::size_t light) {
    if (!outcome) {
        m_job.cancel();
        m_outcome = nullptr;
        m_pictures.clear();
        m_thumbs.clear();
        m_refreshing = true;
        clear();
        m_refreshing = false;
        return;
    }
    const std::size_t environment = light / outcome->rotations();
    if (outcome != m_outcome || environment != m_environment) {
        m_outcome = outcome;
        m_environment = environment;
        m_pictures.clear();
        m_thumbs.clear();
        draw();
        fill();
    }
    m_refreshing = true;
    setCurrentRow(static_cast<int>(light % outcome->rotations()));
    m_refreshing = false;
    scrollToItem(currentItem());
}

QImage SweepStrip::picture(std::size_t light) const {
    const std::size_t row = m_outcome ? light % m_outcome->rotations() : 0;
    return row < m_pictures.size() ? m_pictures[row] : QImage();
}

void SweepStrip::draw() {
    m_job.cancel(); // of another environment
    m_job.request([this, outcome = m_outcome, environment = m_environment,
                   size = thumbSize() *
                          devicePixelRatioF()](const JobContext& job) -> LatestJob::Apply {
        std::vector<QImage> pictures, thumbs;
        const QRect seen = surfacesRect(outcome->pixels);
        for (std::size_t r = 0; r < outcome->rotations(); ++r) {
            if (job.cancelled())
                return {};
            const LightScore& score = outcome->sweep.scores[environment * outcome->rotations() + r];
            pictures.push_back(displayedImage(sweepPicture(outcome->pixels, outcome->measured,
                                                           outcome->settings, score.light),
                                              outcome->settings.view)
                                   .copy(seen));
        }
        for (const QImage& picture : pictures)
            thumbs.push_back(picture.scaled(size, Qt::KeepAspectRatio, Qt::SmoothTransformation));
        return [this, pictures = std::move(pictures), thumbs = std::move(thumbs)] {
            m_pictures = pictures;
            m_thumbs = thumbs;
            fill();
            Q_EMIT picturesChanged();
        };
    });
}

QSize SweepStrip::thumbSize() const {
    return surfacesRect(m_outcome->pixels)
        .size()
        .scaled(kStripWidest, kStripHeight, Qt::KeepAspectRatio);
}

void SweepStrip::fill() {
    m_refreshing = true;
    const int rows = static_cast<int>(m_outcome->rotations());
    while (count() > rows)
        delete takeItem(count() - 1);
    while (count() < rows)
        addItem(new QListWidgetItem);
    const QSize size = thumbSize();
    setIconSize(size);
    const QString widest = rotationText(333.3);
    for (int row = 0; row < rows; ++row) {
        const LightScore& score =
            m_outcome->sweep
                .scores[m_environment * m_outcome->rotations() + static_cast<std::size_t>(row)];
        QListWidgetItem& one = *item(row);
        one.setText(rotationText(score.light.rotationDeg));
        one.setToolTip(tr("%1 at %2: difference %3")
                           .arg(toQString(m_outcome->environments[m_environment].title), one.text(),
                                scoreText(score.difference.worst, RankBy::Difference)));
        one.setSizeHint(size.expandedTo({fontMetrics().horizontalAdvance(widest), 0}) +
                        QSize(tokens::kGap, fontMetrics().height() + tokens::kGap / 2));
        one.setIcon(m_thumbs.empty()
                        ? QIcon()
                        : stripIcon(m_thumbs[static_cast<std::size_t>(row)], devicePixelRatioF()));
    }
    m_refreshing = false;
}

} // namespace patina::editor
