# The developer's verbs. Each is a script in tools/ that can be run by itself. GNU make.

.DEFAULT_GOAL := help
.PHONY: help demo gallery test core snapshots figures bench document format objects
.PHONY: check-valgrind check-databases check-nosuggests check-manual check-coverage check-fuzz check-fuzz-sanitized
.PHONY: check-kill-sweep check-remote check-architectures check-completion manpages deb check-cran paper
.PHONY: map check-animations check-damage check-interrupt check-lessons check-long check-measurement check-mutants check-scenes library examples
.PHONY: lab site check-lab check-browsers check-faces check-site

help: ## this list
	@sed -n 's/^\([a-z-]*\):.*## /  make \1\t/p' $(firstword $(MAKEFILE_LIST)) | expand -t 30

demo: ## install what is missing and the package, run the main job, pictures in demo-output/
	@sh tools/setup.sh demo
	@sh tools/install.sh
	@Rscript tools/demo.R

gallery: ## every picture as PNG in gallery/, with a sheet of all, gallery/index.html
	@sh tools/install.sh --no-build-vignettes
	@Rscript tools/gallery.R

test: ## install what is missing, then run every check
	@sh tools/run-tests.sh

core: ## the tests of the C core alone
	@sh tests/core/run.sh

snapshots: ## write the text snapshots anew; read the diff before you commit it
	@sh tools/install.sh --no-build-vignettes
	-@cd tests && NOT_CRAN=true Rscript testthat.R
	@Rscript -e 'testthat::snapshot_accept(path = "tests/testthat")'

figures: ## write tests/core/api/figures.txt anew; read the diff before you commit it
	@sh tests/core/run.sh --figures

bench: ## speed and error beside other tools
	@sh tools/setup.sh bench
	@sh tools/install.sh --no-build-vignettes
	@Rscript bench/run.R

document: ## make NAMESPACE and man/ from the comments in R/
	@sh tools/setup.sh document
	@sh tools/install.sh --no-build-vignettes
	@Rscript -e 'roxygen2::roxygenise(load_code = roxygen2::load_installed)'
	@./cleanup

lab: ## the page of the lab, inst/lab, from web/ and the core
	@sh tools/setup.sh lab
	@sh tools/lab.sh

site: ## the site of the package in site/, with the lab: pkgdown, offline
	@sh tools/setup.sh site
	@sh tools/install.sh --no-build-vignettes
	@sh tools/site.sh

check-site: ## the site in Chromium: axe-core, no request to elsewhere, search, pictures: SITE= where
	@sh tools/check-site.sh

check-lab: ## the lab: numbers beside the native core, every control by the keyboard in Chromium
	@sh tools/check-lab.sh

check-faces: ## scenes through R, the command line, the C library, Python and WebAssembly: the same
	@sh tools/check-faces.sh

check-browsers: ## the lab in Firefox and WebKit beside Chromium: SHOTS= a folder for pictures
	@sh tools/check-browsers.sh

library: ## the core as a library of C, with its header: PREFIX= DESTDIR= LIBDIR= LDFLAGS=
	@DESTDIR="$(DESTDIR)" LIBDIR="$(LIBDIR)" LDFLAGS="$(LDFLAGS)" sh tools/library.sh $(PREFIX)

deb: ## Debian packages by packaging/debian, checked by lintian: DIR= where
	@sh tools/debian.sh $(DIR)

examples: ## the programs of inst/examples, compared with R
	@sh tools/examples.sh

objects: ## list the C files of src/ for make, after one came or went
	@sh tools/objects.sh > src/Makevars.objects

map: ## what each file of R/ and src/ is for
	@sh tools/map.sh

format: ## lay out the C sources by .clang-format
	@sh tools/setup.sh format
	@find src tests/core web inst/include -name '*.[ch]' -exec clang-format -i {} +

check-valgrind: ## C core and C boundary under valgrind
	@sh tools/check-valgrind.sh

check-databases: ## tables, rows and wrong rows in SQLite, PostgreSQL and DuckDB; files of sweeps
	@sh tools/check-databases.sh

check-kill-sweep: ## kill daemons, coordinators and jobs of sweeps at random moments: KILLS=30 SEED=
	@sh tools/kill-sweep.sh $(or $(KILLS),30) $(SEED)

check-remote: ## sweeps by daemons through an sshd of its own and TLS
	@sh tools/check-remote.sh

check-damage: ## random and damaged calls of the C interface under sanitizers: CALLS=1000000 SEED=
	@sh tools/check-damage.sh

check-animations: ## five animations driven by the keyboard in Chromium, axe-core's rules
	@sh tools/check-animations.sh

check-lessons: ## every lesson with README's packages alone, its outputs counted, in Chromium
	@sh tools/check-lessons.sh

check-scenes: ## every scene and body that the tests make, as text and back
	@sh tools/check-scenes.sh

check-nosuggests: ## check and tests with the imported packages alone
	@sh tools/check-nosuggests.sh

check-long: ## make test with all random cases, every vignette again, clang's optimised build
	@ROTDYN_LONG=yes sh tools/run-tests.sh

check-mutants: ## small wrong changes of the sources: do the tests notice: MUTANTS=200 SEED=
	@sh tools/check-mutants.sh $(or $(MUTANTS),200) $(SEED)

check-measurement: ## do the error bars of measured motions hold the truth: RECORDS=500, SEED=
	@sh tools/check-measurement.sh $(or $(RECORDS),500) $(SEED)

check-architectures: ## the C core on arm64, i386, armhf, ppc64el, s390x: ARCHITECTURES= SCENES=1000 TESTS=no
	@ARCHITECTURES="$(ARCHITECTURES)" SCENES="$(SCENES)" TESTS="$(TESTS)" sh tools/check-architectures.sh

check-cran: ## the check as CRAN runs it: verdicts, processor time by part, licences: VIGNETTES=no
	@VIGNETTES="$(VIGNETTES)" sh tools/check-cran.sh

paper: ## the paper of paper/, each number and the figure computed: DIR= where
	@sh tools/install.sh --no-build-vignettes
	@Rscript paper/build.R $(or $(DIR),paper/built)

check-completion: ## completions of bash, zsh and fish, typed under a terminal
	@sh tools/check-completion.sh

manpages: ## manual pages of the command line in man1/, from the installed package: DIR=
	@sh tools/manpages.sh $(DIR)

check-coverage: ## do the reported errors cover the true ones: SCENES=1000 of each class, SEED=
	@sh tools/setup.sh coverage
	@sh tools/check-coverage.sh $(or $(SCENES),1000) $(SEED)

check-fuzz-sanitized: ## the same under gcc's address and undefined behaviour sanitizers
	@SANITIZED=yes sh tools/check-fuzz.sh $(or $(MINUTES),10) $(SEED)

check-fuzz: ## random calls of every function and damaged files: MINUTES=30 SEED=
	@sh tools/check-fuzz.sh $(or $(MINUTES),30) $(SEED)

check-interrupt: ## Ctrl-C stops every long call within a second
	@sh tools/check-interrupt.sh

check-manual: ## the PDF manual, where LaTeX is installed
	@sh tools/check-manual.sh
