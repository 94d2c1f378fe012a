# The installed package: find_package(wend) gives the target wend::guide.
