// Linked with one module of core/ and what it depends on (cmake/PatinaModule.cmake): whether
// nothing is missing is for the linker to say.
int main() {
    return 0;
}
