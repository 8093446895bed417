#include "app/editor/widget/SkyGallery.h"

#include "app/editor/style/Tokens.h"
#include "app/editor/widget/RecentSkies.h"
#include "app/editor/widget/Thumbnails.h"
#include "core/library/Library.h"
#include "core/light/Environment.h"

#include <QFileInfo>
#include <QGridLayout>
#include <QPixmap>
#include <QPointer>
#include <QTimer>
#include <QToolButton>
#include <algorithm>

namespace patina::editor {
namespace {
constexpr int kColumns = 3;
constexpr QSize kPicture{84, 42};
constexpr int kPreviewDelayMs = 1500; // the first frame of the scene goes before
} // namespace

SkyGallery::SkyGallery(QWidget* parent)
    : QWidget(parent)
    , m_grid(new QGridLayout(this)) {
    m_grid->setContentsMargins(0, 0, 0, 0);
    m_grid->setSpacing(4);
    for (const library::Entry& entry : library::environments())
        m_skies.push_back(makeSky(QStringLiteral("builtin:") + QString::fromStdString(entry.name),
                                  QString::fromStdString(entry.title),
                                  QString::fromStdString(entry.help)));
    for (const QString& file : recentSkies()) {
        m_recent.push_back(makeSky(file, QFileInfo(file).completeBaseName(), file));
        if (const QImage picture = skyPicture(file); !picture.isNull())
            m_recent.back().button->setIcon(QPixmap::fromImage(picture));
    }
    layOut();
}

SkyGallery::Sky SkyGallery::makeSky(const QString& source, const QString& title,
                                    const QString& help) {
    auto* button = new QToolButton;
    button->setObjectName(QStringLiteral("sky"));
    button->setText(fontMetrics().elidedText(title, Qt::ElideMiddle, kPicture.width()));
    button->setToolTip(help);
    button->setStatusTip(help);
    button->setAccessibleName(tr("Environment %1").arg(title));
    button->setToolButtonStyle(Qt::ToolButtonTextUnderIcon);
    button->setIconSize(kPicture);
    QPixmap blank(kPicture);
    blank.fill(QColor(tokens::kWell));
    button->setIcon(blank);
    button->setCheckable(true);
    button->setFocusPolicy(Qt::TabFocus);
    button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    connect(button, &QToolButton::clicked, this, [this, source] { Q_EMIT chosen(source); });
    return {source, button};
}

void SkyGallery::layOut() {
    int index = 0;
    for (const std::vector<Sky>* skies : {&m_skies, &m_recent})
        for (const Sky& sky : *skies) {
            m_grid->addWidget(sky.button, index / kColumns, index % kColumns);
            ++index;
        }
}

void SkyGallery::setCurrent(const QString& source) {
    m_current = source;
    for (const std::vector<Sky>* skies : {&m_skies, &m_recent})
        for (const Sky& sky : *skies)
            sky.button->setChecked(sky.source == source);
}

void SkyGallery::addRecent(const QString& file, const ImagePtr& image) {
    const auto known = std::find_if(m_recent.begin(), m_recent.end(),
                                    [&](const Sky& sky) { return sky.source == file; });
    if (known != m_recent.end() && file == m_current)
        return;
    rememberSky(file);
    if (known != m_recent.end())
        return; // it stays where it is in this session
    m_recent.insert(m_recent.begin(), makeSky(file, QFileInfo(file).completeBaseName(), file));
    while (m_recent.size() > std::size_t{kMostRecentSkies}) {
        m_recent.back().button->hide();
        m_recent.back().button->deleteLater(); // it may be what was clicked
        m_recent.pop_back();
    }
    layOut();
    setCurrent(m_current);
    if (!m_tasks || !image)
        return;
    makePicture([image] { return image; },
                [file, button = QPointer(m_recent.front().button)](const QImage& picture) {
                    keepSkyPicture(file, picture);
                    if (button)
                        button->setIcon(QPixmap::fromImage(picture));
                });
}

void SkyGallery::makePicture(const std::function<ImagePtr()>& image,
                             const std::function<void(const QImage&)>& show) {
    m_tasks->run(
        {.tag = "previews of environments",
         .policy = TaskPolicy::Queue,
         .priority = TaskPriority::Low},
        [image](const JobContext&) {
            const ImagePtr found = image();
            return found ? displayImage(*found, 2 * kPicture.width()) : QImage();
        },
        [show](const Result<QImage>& picture) {
            if (picture && !picture->isNull())
                show(*picture);
        });
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
        makePicture(
            [name = sky.source.mid(8).toStdString()] {
                const auto image = library::environment(name);
                return image ? *image : nullptr;
            },
            [button = QPointer(sky.button)](const QImage& picture) {
                if (button)
                    button->setIcon(QPixmap::fromImage(picture));
            });
    }
}

} // namespace patina::editor
