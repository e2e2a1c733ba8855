# A scene to which the program adds what the file does not say, such as draw_over; what changes is drawn alone.
override SCENE_FLAGS := --simplify safe --set incremental=2 $(SCENE_FLAGS)
