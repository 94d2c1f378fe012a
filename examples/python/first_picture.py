"""Your first guided picture: the demo scene, rendered classically and guided in the same time."""

import wend

scene = wend.load(wend.demo_scene())
film = wend.render(scene, time=10)
film.save("demo.exr")
print(film.statistics["spp"], "samples per pixel; relative error", wend.metric(film, wend.demo_scene().with_suffix("")))
