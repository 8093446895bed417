// Rows of panels by the parameter that they edit, drags, and images dropped on them.
#pragma once

#include "core/material/Material.h"
#include "tests/app/editor/EditorFixture.h"

#include "app/editor/panel/ParameterList.h"
#include "core/io/ImageIO.h"

#include <QDropEvent>
#include <QMimeData>

namespace patina::editor {

struct PanelTest : EditorTest {
    static ParameterRow& row(std::string_view id) {
        ParameterRow* found = nullptr;
        for (ParameterList* list : window->findChildren<ParameterList*>())
            if (ParameterRow* candidate = list->row(id))
                found = candidate;
        EXPECT_NE(found, nullptr) << id;
        return *found;
    }
    template <class Widget>
    static Widget& in(std::string_view id) {
        auto* widget = row(id).findChild<Widget*>();
        EXPECT_NE(widget, nullptr) << id;
        return *widget;
    }
    static void drag(QWidget& widget, QPoint from, std::initializer_list<int> way) {
        QTest::mousePress(&widget, Qt::LeftButton, {}, from);
        for (const int pixels : way)
            QTest::mouseMove(&widget, from + QPoint(pixels, 0));
        QTest::mouseRelease(&widget, Qt::LeftButton, {}, from + QPoint(*(way.end() - 1), 0));
    }
    static void drop(QWidget& widget, const QString& file) {
        QMimeData data;
        data.setUrls({QUrl::fromLocalFile(file)});
        QDragEnterEvent enter(widget.rect().center(), Qt::CopyAction, &data, Qt::LeftButton, {});
        QApplication::sendEvent(&widget, &enter);
        EXPECT_TRUE(enter.isAccepted());
        QDropEvent event(QPointF(widget.rect().center()), Qt::CopyAction, &data, Qt::LeftButton,
                         {});
        QApplication::sendEvent(&widget, &event);
        EXPECT_TRUE(event.isAccepted());
    }
    QString writeImage(const QString& name) {
        Image image(8, 8, 3, PixelType::U8, ColorEncoding::Srgb);
        std::fill(image.u8().begin(), image.u8().end(), std::uint8_t{77});
        const QString file = folder.filePath(name);
        EXPECT_TRUE(saveImage(session->worker, image, file.toStdString()).ok());
        return file;
    }
    static constexpr const char* kRough = "material.perceptualRoughness";
    static float roughness() { return selectedMaterial().perceptualRoughness; }
};

} // namespace patina::editor
