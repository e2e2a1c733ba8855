APP_LIB := # it draws nothing
