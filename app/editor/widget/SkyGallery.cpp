#include "app/editor/widget/SkyGallery.h"

#include "app/editor/document/BackgroundTasks.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/Thumbnails.h"
#include "core/library/Library.h"

#include <QGridLayout>
#include <QPixmap>
#include <QPointer>
#include <QTimer>
#include <QToolButton>

namespace patina::editor {
namespace {
constexpr int kColumns = 3;
constexpr QSize kPicture{84, 42};
constexpr int kPreviewDelayMs = 1500; // the first frame of the scene goes before
} // namespace

SkyGallery::SkyGallery(QWidget* parent)
    : QWidget(parent) {
    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setSpacing(4);
    int index = 0;
    for (const library::Entry& entry : library::environments()) {
        auto* button = new QToolButton;
        button->setObjectName(QStringLiteral("sky"));
        button->setText(QString::fromStdString(entry.title));
        button->setToolTip(QString::fromStdString(entry.help));
        button->setStatusTip(QString::fromStdString(entry.help));
        button->setAccessibleName(tr("Environment %1").arg(button->text()));
        button->setToolButtonStyle(Qt::ToolButtonTextUnderIcon);
        button->setIconSize(kPicture);
        QPixmap blank(kPicture);
        blank.fill(QColor(tokens::kWell));
        button->setIcon(blank);
        button->setCheckable(true);
        button->setFocusPolicy(Qt::TabFocus);
        button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
        const QString source = QStringLiteral("builtin:") + QString::fromStdString(entry.name);
        connect(button, &QToolButton::clicked, this, [=, this] { Q_EMIT chosen(source); });
        m_skies.push_back({source, button});
        grid->addWidget(button, index / kColumns, index % kColumns);
        ++index;
    }
}

void SkyGallery::setCurrent(const QString& source) {
    for (const Sky& sky : m_skies)
        sky.button->setChecked(sky.source == source);
}

void SkyGallery::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    if (m_requested || !m_tasks)
        return;
    m_requested = true;
    QTimer::singleShot(kPreviewDelayMs, this, &SkyGallery::makePictures);
}

void SkyGallery::makePictures() {
    for (const Sky& sky : m_skies) {
        const auto work = [name = sky.source.mid(8).toStdString(), button = QPointer(sky.button)](
                              const JobContext& job) -> BackgroundTasks::Apply {
            if (job.cancelled())
                return {};
            const auto image = library::environment(name);
            if (!image.ok())
                return {};
            const QImage picture = displayImage(*image.value(), 2 * kPicture.width());
            return [button, picture] {
                if (button)
                    button->setIcon(QPixmap::fromImage(picture));
            };
        };
        m_tasks->start(QStringLiteral("sky:") + sky.source, tr("Preparing previews"), work);
    }
}

} // namespace patina::editor
