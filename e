env: ‘/work/mem/build/release/bin/tspace.new’: No such file or directory
