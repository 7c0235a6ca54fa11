#pragma once
// Included by the .cpp files that talk to VTK.

#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkObject.h>

#include <string>

namespace gneiss {

/// Collects the error messages of the VTK objects it listens to, which would go to stderr otherwise.
class VtkMessages {
public:
    VtkMessages() {
        observer_->SetCallback([](vtkObject*, unsigned long, void* messages, void* message) {
            if (message) *static_cast<std::string*>(messages) += static_cast<const char*>(message);
        });
        observer_->SetClientData(&text_);
    }
    VtkMessages(const VtkMessages&) = delete;
    VtkMessages& operator=(const VtkMessages&) = delete;

    void listen_to(vtkObject* object) { object->AddObserver("ErrorEvent", observer_); }
    const std::string& text() const { return text_; }

private:
    vtkNew<vtkCallbackCommand> observer_;
    std::string text_;
};

}  // namespace gneiss
