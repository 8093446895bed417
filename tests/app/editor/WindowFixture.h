// The whole window: what is modified, asked, dropped and saved.
#pragma once

#include "core/material/Material.h"
#include "tests/app/editor/EditorFixture.h"

#include <QDropEvent>
#include <QFile>
#include <QMessageBox>
#include <QMimeData>
#include <QPushButton>
#include <QTest>

namespace patina::editor {

struct WindowTest : EditorTest {
    void TearDown() override {
        for (QMessageBox* box : window->findChildren<QMessageBox*>())
            box->done(QMessageBox::Cancel);
    }
    static void modify() {
        controller().setParameter(parameter("material.perceptualRoughness"),
                                  {Scope::Material, selectedMaterial().id}, 0.123f);
        ASSERT_TRUE(controller().isModified());
    }
    static QMessageBox* question() {
        for (QMessageBox* box : window->findChildren<QMessageBox*>())
            if (box->isVisible())
                return box;
        return nullptr;
    }
    static void answer(QMessageBox::StandardButton button) {
        ASSERT_NE(question(), nullptr);
        QTest::mouseClick(question()->button(button), Qt::LeftButton);
    }
    static void dropOnWindow(const QStringList& files) {
        QMimeData data;
        QList<QUrl> urls;
        for (const QString& file : files)
            urls << QUrl::fromLocalFile(file);
        data.setUrls(urls);
        QDragEnterEvent enter({300, 300}, Qt::CopyAction, &data, Qt::LeftButton, {});
        QApplication::sendEvent(window.get(), &enter);
        ASSERT_TRUE(enter.isAccepted());
        QDropEvent event({300, 300}, Qt::CopyAction, &data, Qt::LeftButton, {});
        QApplication::sendEvent(window.get(), &event);
    }
    QString saveProjectFile(const QString& name) {
        const QString file = folder.filePath(name);
        bool worked = false;
        controller().saveAs(file, [&](bool ok) { worked = ok; });
        EXPECT_TRUE(settled(*session));
        EXPECT_TRUE(worked);
        return file;
    }
    QString writeObj(const QString& name) {
        QFile file(folder.filePath(name));
        EXPECT_TRUE(file.open(QIODevice::WriteOnly));
        file.write("o Triangle\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        return file.fileName();
    }
};

} // namespace patina::editor
